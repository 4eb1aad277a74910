#version 3.5;
#include "transforms.inc"
background { color rgb <1, 1, 1>}
camera {
  orthographic
  location <0, 1e+06, 0>
  direction <0, -2.02, 0>
  right <18.5222, 0, 0>
  up <0, 0, 13.8917>
  sky <0, 0, 13.8917>
  Axis_Rotate_Trans(<0, 1, 0>, 0)
  translate <4.35103, 4.28774, 4.13545>
}
light_source {
  <0, 0, 0>
  color <1.5, 1.5, 1.5>
  shadowless
  parallel
  point_at <0, -1, 0>
}
#macro SPRTCLE(pos, particleRadius, particleColor) // spherical particles
sphere { pos, particleRadius
         texture { pigment { color particleColor } }
}
#end
#macro DPRTCLE(pos, particleRadius, particleColor) // discs that face the camera
disc { pos, <0, 1, 0>, particleRadius
         texture { pigment { color particleColor } }
}
#end
#macro CPRTCLE(pos, particleRadius, particleColor) // cubes
box { pos - <particleRadius,particleRadius,particleRadius>, pos + <particleRadius,particleRadius,particleRadius>
         texture { pigment { color particleColor } }
}
#end
#macro CYL(base, dir, cylRadius, cylColor)
cylinder { base, base + dir, cylRadius
         texture { pigment { color cylColor } }
}
#end
SPRTCLE(<3.5, 0.5, 4.25>, 0.75, rgbt <1, 0.0509804, 0.0509804, 0>)
DPRTCLE(<3.5, 1.25, 5.25>, 0.75, rgbt <1, 0.0509804, 0.0509804, 0>)
CPRTCLE(<6.5, 1.5, 4.75>, 0.5, rgbt <0, 0.0509804, 0.0509804, 0>)
CYL(<6.5, 1.5, 4.75>, <0, 0, 2>, 0.25, rgbt <0, 1, 0, 0>)
