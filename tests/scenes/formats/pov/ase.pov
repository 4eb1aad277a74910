#include "colors.inc"
#include "finish.inc"

global_settings {assumed_gamma 1 max_trace_level 6}
background {color White}
camera {orthographic
  right -10.39*x up 7.51*y
  direction 1.00*z
  location <0,0,50.00> look_at <0,0,0>}


light_source {<  2.00,   3.00,  40.00> color White
  area_light <0.70, 0, 0>, <0, 0.70, 0>, 3, 3
  adaptive 1 jitter}
// no fog
#declare simple = finish {phong 0.7}
#declare pale = finish {ambient 0.5 diffuse 0.85 roughness 0.001 specular 0.200 }
#declare intermediate = finish {ambient 0.3 diffuse 0.6 specular 0.1 roughness 0.04}
#declare vmd = finish {ambient 0.0 diffuse 0.65 phong 0.1 phong_size 40.0 specular 0.5 }
#declare jmol = finish {ambient 0.2 diffuse 0.6 specular 1 roughness 0.001 metallic}
#declare ase2 = finish {ambient 0.05 brilliance 3 diffuse 0.6 metallic specular 0.7 roughness 0.04 reflection 0.15}
#declare ase3 = finish {ambient 0.15 brilliance 2 diffuse 0.6 metallic specular 1.0 roughness 0.001 reflection 0.0}
#declare glass = finish {ambient 0.05 diffuse 0.3 specular 1.0 roughness 0.001}
#declare glass2 = finish {ambient 0.01 diffuse 0.3 specular 1.0 reflection 0.25 roughness 0.001}
#declare Rcell = 0.050;
#declare Rbond = 0.100;

#macro atom(LOC, R, COL, TRANS, FIN)
  sphere{LOC, R texture{pigment{color COL transmit TRANS} finish{FIN}}}
#end
#macro constrain(LOC, R, COL, TRANS FIN)
union{torus{R, Rcell rotate 45*z texture{pigment{color COL transmit TRANS} finish{FIN}}}
     torus{R, Rcell rotate -45*z texture{pigment{color COL transmit TRANS} finish{FIN}}}
     translate LOC}
#end

cylinder {< -2.63,  -2.57,  -9.11>, <  4.95,  -2.57,  -6.35>, Rcell pigment {Black}}
cylinder {< -3.00,   3.58,  -8.09>, <  4.58,   3.58,  -5.33>, Rcell pigment {Black}}
cylinder {< -4.95,   2.57,  -2.74>, <  2.63,   2.57,   0.01>, Rcell pigment {Black}}
cylinder {< -4.58,  -3.58,  -3.76>, <  3.00,  -3.58,  -1.01>, Rcell pigment {Black}}
cylinder {< -2.63,  -2.57,  -9.11>, < -3.00,   3.58,  -8.09>, Rcell pigment {Black}}
cylinder {<  4.95,  -2.57,  -6.35>, <  4.58,   3.58,  -5.33>, Rcell pigment {Black}}
cylinder {<  3.00,  -3.58,  -1.01>, <  2.63,   2.57,   0.01>, Rcell pigment {Black}}
cylinder {< -4.58,  -3.58,  -3.76>, < -4.95,   2.57,  -2.74>, Rcell pigment {Black}}
cylinder {< -2.63,  -2.57,  -9.11>, < -4.58,  -3.58,  -3.76>, Rcell pigment {Black}}
cylinder {<  4.95,  -2.57,  -6.35>, <  3.00,  -3.58,  -1.01>, Rcell pigment {Black}}
cylinder {<  4.58,   3.58,  -5.33>, <  2.63,   2.57,   0.01>, Rcell pigment {Black}}
cylinder {< -3.00,   3.58,  -8.09>, < -4.95,   2.57,  -2.74>, Rcell pigment {Black}}
atom(<  1.05,  -0.48,  -4.26>, 0.76, rgb <0.56, 0.56, 0.56>, 0.0, ase3) // #0
atom(< -0.11,   0.47,  -4.50>, 0.76, rgb <0.56, 0.56, 0.56>, 0.0, ase3) // #1
atom(< -1.18,  -0.31,  -5.03>, 0.66, rgb <1.00, 0.05, 0.05>, 0.0, ase3) // #2
atom(< -1.93,   0.29,  -5.19>, 0.31, rgb <1.00, 1.00, 1.00>, 0.0, ase3) // #3
atom(< -0.40,   0.95,  -3.56>, 0.31, rgb <1.00, 1.00, 1.00>, 0.0, ase3) // #4
atom(<  0.19,   1.26,  -5.20>, 0.31, rgb <1.00, 1.00, 1.00>, 0.0, ase3) // #5
atom(<  1.91,   0.06,  -3.84>, 0.31, rgb <1.00, 1.00, 1.00>, 0.0, ase3) // #6
atom(<  0.75,  -1.26,  -3.55>, 0.31, rgb <1.00, 1.00, 1.00>, 0.0, ase3) // #7
atom(<  1.35,  -0.95,  -5.19>, 0.31, rgb <1.00, 1.00, 1.00>, 0.0, ase3) // #8
cylinder {<  1.05,  -0.48,  -4.26>, <  0.47,  -0.01,  -4.38>, Rbond texture{pigment {color rgb <0.56, 0.56, 0.56> transmit 0.0} finish{ase3}}}
cylinder {< -0.11,   0.47,  -4.50>, <  0.47,  -0.01,  -4.38>, Rbond texture{pigment {color rgb <0.56, 0.56, 0.56> transmit 0.0} finish{ase3}}}
cylinder {<  1.05,  -0.48,  -4.26>, <  1.48,  -0.21,  -4.05>, Rbond texture{pigment {color rgb <0.56, 0.56, 0.56> transmit 0.0} finish{ase3}}}
cylinder {<  1.91,   0.06,  -3.84>, <  1.48,  -0.21,  -4.05>, Rbond texture{pigment {color rgb <1.00, 1.00, 1.00> transmit 0.0} finish{ase3}}}
cylinder {<  1.05,  -0.48,  -4.26>, <  0.90,  -0.87,  -3.90>, Rbond texture{pigment {color rgb <0.56, 0.56, 0.56> transmit 0.0} finish{ase3}}}
cylinder {<  0.75,  -1.26,  -3.55>, <  0.90,  -0.87,  -3.90>, Rbond texture{pigment {color rgb <1.00, 1.00, 1.00> transmit 0.0} finish{ase3}}}
cylinder {<  1.05,  -0.48,  -4.26>, <  1.20,  -0.71,  -4.72>, Rbond texture{pigment {color rgb <0.56, 0.56, 0.56> transmit 0.0} finish{ase3}}}
cylinder {<  1.35,  -0.95,  -5.19>, <  1.20,  -0.71,  -4.72>, Rbond texture{pigment {color rgb <1.00, 1.00, 1.00> transmit 0.0} finish{ase3}}}
cylinder {< -0.11,   0.47,  -4.50>, < -0.64,   0.08,  -4.77>, Rbond texture{pigment {color rgb <0.56, 0.56, 0.56> transmit 0.0} finish{ase3}}}
cylinder {< -1.18,  -0.31,  -5.03>, < -0.64,   0.08,  -4.77>, Rbond texture{pigment {color rgb <1.00, 0.05, 0.05> transmit 0.0} finish{ase3}}}
cylinder {< -0.11,   0.47,  -4.50>, < -0.26,   0.71,  -4.03>, Rbond texture{pigment {color rgb <0.56, 0.56, 0.56> transmit 0.0} finish{ase3}}}
cylinder {< -0.40,   0.95,  -3.56>, < -0.26,   0.71,  -4.03>, Rbond texture{pigment {color rgb <1.00, 1.00, 1.00> transmit 0.0} finish{ase3}}}
cylinder {< -0.11,   0.47,  -4.50>, <  0.04,   0.86,  -4.85>, Rbond texture{pigment {color rgb <0.56, 0.56, 0.56> transmit 0.0} finish{ase3}}}
cylinder {<  0.19,   1.26,  -5.20>, <  0.04,   0.86,  -4.85>, Rbond texture{pigment {color rgb <1.00, 1.00, 1.00> transmit 0.0} finish{ase3}}}
cylinder {< -1.18,  -0.31,  -5.03>, < -1.55,  -0.01,  -5.11>, Rbond texture{pigment {color rgb <1.00, 0.05, 0.05> transmit 0.0} finish{ase3}}}
cylinder {< -1.93,   0.29,  -5.19>, < -1.55,  -0.01,  -5.11>, Rbond texture{pigment {color rgb <1.00, 1.00, 1.00> transmit 0.0} finish{ase3}}}
// no constraints
