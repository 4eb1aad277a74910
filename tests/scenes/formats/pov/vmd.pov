// In the form that VMD writes.
// try povray +W512 +H512 -Ivmd.pov -Ovmd.pov.tga +P +X +A +FT +C
#if (version < 3.5)
#error "needs POV-Ray 3.5 or above.\nPlease upgrade."
#end
#declare VMD_clip_on=array[3] {0, 0, 0};
#declare VMD_clip=array[3];
#declare VMD_line_width=0.0020;
#macro VMDC ( C1 )
  texture { pigment { rgbt C1 }}
#end
#macro VMD_sphere (P1, R1, C1)
  #local T = texture { pigment { C1 } }
  #if(VMD_clip_on[2])
  intersection {
    sphere {P1, R1 texture {T} #if(VMD_clip_on[1]) clipped_by {VMD_clip[1]} #end no_shadow}
    VMD_clip[2]
  }
  #else
  sphere {P1, R1 texture {T} #if(VMD_clip_on[1]) clipped_by {VMD_clip[1]} #end no_shadow}
  #end
#end
#macro VMD_cylinder (P1, P2, R1, C1, O1)
  #local T = texture { pigment { C1 } }
  cylinder {P1, P2, R1 #if(O1) open #end texture {T} no_shadow}
#end
#macro VMD_triangle (P1, P2, P3, N1, N2, N3, C1)
  #local T = texture { pigment { C1 } }
  smooth_triangle {P1, N1, P2, N2, P3, N3 texture {T} no_shadow}
#end
camera {
  orthographic
  location <0.0000, 0.0000, -2.0000>
  look_at <-0.0000, -0.0000, 2.0000>
  up <0.0000, 3.0000, 0.0000>
  right <3.0000, 0.0000, 0.0000>
}
light_source {
  <-0.1000, 0.1000, -1.0000>
  color rgb<1.000, 1.000, 1.000>
  parallel
  point_at <0.0, 0.0, 0.0>
}
background {
  color rgb<1.000, 1.000, 1.000>
}
fog {
  distance 3.1250
  fog_type 1
  color rgb<1.000, 1.000, 1.000>
}
#default { texture {
 finish { ambient 0.000 diffuse 0.650 phong 0.1 phong_size 40.000 specular 0.500 }
} }
VMD_sphere(<-0.0000,0.0000,-0.0000>,0.2645,rgbt<0.000,0.000,1.000,0.000>)
VMD_sphere(<0.4640,-0.2429,-0.6897>,0.2594,rgbt<1.000,0.000,0.000,0.000>)
VMD_cylinder(<0,0,0>,<0.231984,-0.12144,-0.344874>0.0512,rgbt<0.000,0.000,1.000,0.000>,1)
VMD_triangle(<0,0.5,0>,<0.5,0.5,0>,<0,1,0>,<0,0,-1>,<0,0,-1>,<0,0,-1>,rgbt<0,1,0,0.0>)
// End of POV-Ray 3.x generation
