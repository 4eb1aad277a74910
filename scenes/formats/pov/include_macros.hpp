#pragma once

#include <string_view>

/// Shapes and macros with the names and the meaning of those in POV-Ray's own files, in POV-Ray's
/// language. Each declaration begins at the beginning of a line.
namespace raylane::scenes::pov {

inline constexpr std::string_view shapes_old_inc = R"(
#declare Sphere = sphere { 0, 1 }
#declare Ellipsoid = sphere { 0, 1 }
#declare UnitBox = box { -1, 1 }
#declare Cube = box { -1, 1 }
#declare Cylinder_X = quadric { y + z, 0, 0, -1 }
#declare Cylinder_Y = quadric { x + z, 0, 0, -1 }
#declare Cylinder_Z = quadric { x + y, 0, 0, -1 }
#declare QCone_X = quadric { y + z - x, 0, 0, 0 }
#declare QCone_Y = quadric { x + z - y, 0, 0, 0 }
#declare QCone_Z = quadric { x + y - z, 0, 0, 0 }
#declare Paraboloid_X = quadric { y + z, 0, -x, 0 }
#declare Paraboloid_Y = quadric { x + z, 0, -y, 0 }
#declare Paraboloid_Z = quadric { x + y, 0, -z, 0 }
#declare Hyperboloid = quadric { z - x, 0, y, 0 }
#declare Hyperboloid_Y = quadric { x + z - y, 0, 0, -1 }
#declare Cone_X = cone { x, 0, -x, 1 }
#declare Cone_Y = cone { y, 0, -y, 1 }
#declare Cone_Z = cone { z, 0, -z, 1 }
#declare Disk_X = cylinder { -x, x, 1 }
#declare Disk_Y = cylinder { -y, y, 1 }
#declare Disk_Z = cylinder { -z, z, 1 }
#declare Plane_YZ = plane { x, 0 }
#declare Plane_XZ = plane { y, 0 }
#declare Plane_XY = plane { z, 0 }
)";

inline constexpr std::string_view shapes_inc = R"(
#macro Spheroid(Center_, Radius_) sphere { 0, 1 scale Radius_ translate Center_ } #end
#macro Wedge(Degrees_)
  #local Turn_ = mod(Degrees_, 360);
  #if (Turn_ < 180)
    difference { plane { -x, 0 } plane { -x, 0 rotate Turn_ * y } }
  #else
    merge { plane { -x, 0 } plane { x, 0 rotate Turn_ * y } }
  #end
#end
#macro Cone_Around_(A_, Ra_, B_, Rb_)
  #local Axis_ = vnormalize(B_ - A_);
  #local Sine_ = (Ra_ - Rb_) / vlength(B_ - A_);
  #local Cosine_ = sqrt(1 - Sine_ * Sine_);
  cone { A_ + Axis_ * Ra_ * Sine_, Ra_ * Cosine_, B_ + Axis_ * Rb_ * Sine_, Rb_ * Cosine_ }
#end
#macro Connect_Spheres(A_, Ra_, B_, Rb_) Cone_Around_(A_, Ra_, B_, Rb_) #end
#macro Round_Cone2(A_, Ra_, B_, Rb_, Merge_)
  #if (Merge_) merge { #else union { #end
    sphere { A_, Ra_ }
    sphere { B_, Rb_ }
    Cone_Around_(A_, Ra_, B_, Rb_)
  }
#end
#macro Round_Cone2_Union(A_, Ra_, B_, Rb_) Round_Cone2(A_, Ra_, B_, Rb_, 0) #end
#macro Round_Cone2_Merge(A_, Ra_, B_, Rb_) Round_Cone2(A_, Ra_, B_, Rb_, 1) #end
#macro Round_Cone3(A_, Ra_, B_, Rb_, Merge_)
  #local Slope_ = (Rb_ - Ra_) / vlength(B_ - A_);
  #local Along_ = Slope_ * vnormalize(B_ - A_);
  #local Longer_ = sqrt(1 + Slope_ * Slope_);
  #if (Merge_) merge { #else union { #end
    cone { A_, Ra_, B_, Rb_ }
    sphere { A_ + Ra_ * Along_, Ra_ * Longer_ }
    sphere { B_ + Rb_ * Along_, Rb_ * Longer_ }
  }
#end
#macro Round_Cone3_Union(A_, Ra_, B_, Rb_) Round_Cone3(A_, Ra_, B_, Rb_, 0) #end
#macro Round_Cone3_Merge(A_, Ra_, B_, Rb_) Round_Cone3(A_, Ra_, B_, Rb_, 1) #end
#macro Quad(A_, B_, C_, D_) triangle { A_, B_, C_ } triangle { A_, C_, D_ } #end
#macro Smooth_Quad(A_, Na_, B_, Nb_, C_, Nc_, D_, Nd_)
  smooth_triangle { A_, Na_, B_, Nb_, C_, Nc_ }
  smooth_triangle { A_, Na_, C_, Nc_, D_, Nd_ }
#end
#macro Box_Of_Rods_(A_, B_, Radius_, Merge_, Filled_)
  #local Middle_ = (A_ + B_) / 2;
  #local Half_ = <max(abs(A_.x - B_.x) / 2 - Radius_, 0), max(abs(A_.y - B_.y) / 2 - Radius_, 0),
                  max(abs(A_.z - B_.z) / 2 - Radius_, 0)>;
  #local I_ = 0;
  #if (Merge_) merge { #else union { #end
    #while (I_ < 8)
      #local Corner_ = Half_ * <mod(I_, 2) * 2 - 1, mod(int(I_ / 2), 2) * 2 - 1, int(I_ / 4) * 2 - 1>;
      sphere { Middle_ + Corner_, Radius_ }
      #if (Corner_.x < 0 & Half_.x > 0)
        cylinder { Middle_ + Corner_, Middle_ + Corner_ + 2 * Half_.x * x, Radius_ }
      #end
      #if (Corner_.y < 0 & Half_.y > 0)
        cylinder { Middle_ + Corner_, Middle_ + Corner_ + 2 * Half_.y * y, Radius_ }
      #end
      #if (Corner_.z < 0 & Half_.z > 0)
        cylinder { Middle_ + Corner_, Middle_ + Corner_ + 2 * Half_.z * z, Radius_ }
      #end
      #local I_ = I_ + 1;
    #end
    #if (Filled_)
      box { Middle_ - Half_ - Radius_ * x, Middle_ + Half_ + Radius_ * x }
      box { Middle_ - Half_ - Radius_ * y, Middle_ + Half_ + Radius_ * y }
      box { Middle_ - Half_ - Radius_ * z, Middle_ + Half_ + Radius_ * z }
    #end
  }
#end
#macro Wire_Box(A_, B_, Radius_, Merge_) Box_Of_Rods_(A_, B_, Radius_, Merge_, 0) #end
#macro Wire_Box_Union(A_, B_, Radius_) Box_Of_Rods_(A_, B_, Radius_, 0, 0) #end
#macro Wire_Box_Merge(A_, B_, Radius_) Box_Of_Rods_(A_, B_, Radius_, 1, 0) #end
#macro Round_Box(A_, B_, Radius_, Merge_) Box_Of_Rods_(A_, B_, Radius_, Merge_, 1) #end
#macro Round_Box_Union(A_, B_, Radius_) Box_Of_Rods_(A_, B_, Radius_, 0, 1) #end
#macro Round_Box_Merge(A_, B_, Radius_) Box_Of_Rods_(A_, B_, Radius_, 1, 1) #end
)";

/// Polyhedra, constructed from the angles of their faces.
inline constexpr std::string_view shapes2_inc = R"(
#macro Faces_(Count_, Tilt_, Turn_)
  #local I_ = 0;
  #while (I_ < Count_)
    plane { -z, 1 rotate Tilt_ * x rotate -(Turn_ + I_ * 360 / Count_) * y }
    #local I_ = I_ + 1;
  #end
#end
#declare Tetrahedron = intersection { plane { -y, 1 } Faces_(3, 19.47, 0) }
#declare Octahedron = intersection {
  plane { z, 1 rotate 35.26438968275 * x } plane { z, 1 rotate -35.26438968275 * x }
  plane { -z, 1 rotate 35.26438968275 * x } plane { -z, 1 rotate -35.26438968275 * x }
  plane { x, 1 rotate 35.26438968275 * z } plane { x, 1 rotate -35.26438968275 * z }
  plane { -x, 1 rotate 35.26438968275 * z } plane { -x, 1 rotate -35.26438968275 * z }
}
#declare Dodecahedron = intersection {
  plane { y, 1 } plane { -y, 1 } Faces_(5, -26.56505117708, 0) Faces_(5, 26.56505117708, 36)
}
#declare Icosahedron = intersection {
  Faces_(5, 52.6625, 0) Faces_(5, 10.8125, 0) Faces_(5, -52.6625, 36) Faces_(5, -10.8125, 36)
}
#declare HalfCone_Y = cone { -y, 1, y, 0 }
#declare Hexagon = intersection {
  plane { x, 1 } plane { -x, 1 }
  plane { z, 1 } plane { z, 1 rotate 60 * x } plane { z, 1 rotate 120 * x }
  plane { -z, 1 } plane { -z, 1 rotate 60 * x } plane { -z, 1 rotate 120 * x }
}
#declare Rhomboid = intersection {
  plane { x, 1 rotate -30 * z } plane { -x, 1 rotate -30 * z }
  plane { y, 1 } plane { -y, 1 } plane { z, 1 } plane { -z, 1 }
}
#declare Pyramid = union {
  triangle { <-1, -1, -1>, <1, -1, -1>, y } triangle { <1, -1, -1>, <1, -1, 1>, y }
  triangle { <1, -1, 1>, <-1, -1, 1>, y } triangle { <-1, -1, 1>, <-1, -1, -1>, y }
  triangle { <-1, -1, -1>, <1, -1, -1>, <1, -1, 1> }
  triangle { <-1, -1, -1>, <-1, -1, 1>, <1, -1, 1> }
}
#declare Pyramid2 = intersection {
  plane { x, 1 rotate 40 * z } plane { -x, 1 rotate -40 * z }
  plane { z, 1 rotate -40 * x } plane { -z, 1 rotate 40 * x } plane { -y, 0 }
  translate -y
}
#declare Square_X = union {
  triangle { <0, 1, -1>, <0, -1, 1>, <0, 1, 1> } triangle { <0, 1, -1>, <0, -1, 1>, <0, -1, -1> }
}
#declare Square_Y = union {
  triangle { <-1, 0, 1>, <1, 0, -1>, <1, 0, 1> } triangle { <-1, 0, 1>, <1, 0, -1>, <-1, 0, -1> }
}
#declare Square_Z = union {
  triangle { <-1, 1, 0>, <1, -1, 0>, <1, 1, 0> } triangle { <-1, 1, 0>, <1, -1, 0>, <-1, -1, 0> }
}
)";

inline constexpr std::string_view transforms_inc = R"(
#macro Matrix_Trans(A_, B_, C_, D_)
  transform { matrix <A_.x, A_.y, A_.z, B_.x, B_.y, B_.z, C_.x, C_.y, C_.z, D_.x, D_.y, D_.z> }
#end
#macro Shear_Trans(A_, B_, C_) Matrix_Trans(A_, B_, C_, <0, 0, 0>) #end
#macro Axis_Rotate_Trans(Axis_, Angle_)
  Shear_Trans(vaxis_rotate(x, Axis_, Angle_), vaxis_rotate(y, Axis_, Angle_),
              vaxis_rotate(z, Axis_, Angle_))
#end
#macro Rotate_Around_Trans(Rotation_, Point_)
  transform { translate -Point_ rotate Rotation_ translate Point_ }
#end
#macro Reorient_Trans(From_, To_)
  #local Across_ = vcross(From_, To_);
  #if (vlength(Across_) > 0)
    Axis_Rotate_Trans(Across_, VAngleD(From_, To_))
  #else
    #if (vdot(From_, To_) > 0)
      transform { translate 0 }
    #else
      Axis_Rotate_Trans(VPerp_To_Vector(To_), 180)
    #end
  #end
#end
#macro Point_At_Trans(Axis_)
  #local Y_ = vnormalize(Axis_);
  #local X_ = VPerp_To_Vector(Y_);
  Shear_Trans(X_, Y_, vcross(X_, Y_))
#end
)";

inline constexpr std::string_view math_inc = R"(
#macro sind(A_) (sin(radians(A_))) #end
#macro cosd(A_) (cos(radians(A_))) #end
#macro tand(A_) (tan(radians(A_))) #end
#macro asind(A_) (degrees(asin(A_))) #end
#macro acosd(A_) (degrees(acos(A_))) #end
#macro atand(A_) (degrees(atan(A_))) #end
#macro atan2d(A_, B_) (degrees(atan2(A_, B_))) #end
#macro max3(A_, B_, C_) (max(A_, B_, C_)) #end
#macro min3(A_, B_, C_) (min(A_, B_, C_)) #end
#macro even(A_) (select(mod(A_, 2), 0, 1, 0)) #end
#macro odd(A_) (select(mod(A_, 2), 1, 0, 1)) #end
#macro f_sqr(A_) (A_ * A_) #end
#macro sgn(A_) (select(A_, -1, 0, 1)) #end
#macro clip(A_, Min_, Max_) (min(Max_, max(A_, Min_))) #end
#macro clamp(A_, Min_, Max_)
  (mod(A_ - Min_, Max_ - Min_) + select(mod(A_ - Min_, Max_ - Min_), Max_, Min_))
#end
#macro adj_range(A_, Min_, Max_) (Min_ + A_ * (Max_ - Min_)) #end
#macro adj_range2(A_, Min_, Max_, To_min_, To_max_)
  (To_min_ + (A_ - Min_) / (Max_ - Min_) * (To_max_ - To_min_))
#end
#macro Interpolate(At_, From_, To_, Begin_, End_, Exponent_)
  #local Part_ = (At_ - From_) / (To_ - From_);
  #if (Exponent_ = 0)
    #local Part_ = (1 - cos(pi * Part_)) / 2;
  #else
    #local Part_ = pow(Part_, Exponent_);
  #end
  (Begin_ + (End_ - Begin_) * Part_)
#end
#macro Mean(Values_)
  #local Sum_ = 0;
  #for (I_, 0, dimension_size(Values_, 1) - 1)
    #local Sum_ = Sum_ + Values_[I_];
  #end
  (Sum_ / dimension_size(Values_, 1))
#end
#macro Std_Dev(Values_, Mean_)
  #local Sum_ = 0;
  #for (I_, 0, dimension_size(Values_, 1) - 1)
    #local Sum_ = Sum_ + (Values_[I_] - Mean_) * (Values_[I_] - Mean_);
  #end
  (sqrt(Sum_ / dimension_size(Values_, 1)))
#end
#macro VSqr(A_) (A_ * A_) #end
#macro VPow(A_, B_) (<pow(A_.x, B_), pow(A_.y, B_), pow(A_.z, B_)>) #end
#macro VEq(A_, B_) (A_.x = B_.x & A_.y = B_.y & A_.z = B_.z) #end
#macro VZero(A_) (A_.x = 0 & A_.y = 0 & A_.z = 0) #end
#macro VDist(A_, B_) (vlength(A_ - B_)) #end
#macro VWith_Len(A_, Length_) (Length_ * vnormalize(A_)) #end
#macro VMin(A_) (min(A_.x, A_.y, A_.z)) #end
#macro VMax(A_) (max(A_.x, A_.y, A_.z)) #end
#macro VCos_Angle(A_, B_) (vdot(vnormalize(A_), vnormalize(B_))) #end
#macro VAngle(A_, B_) (acos(max(-1, min(1, vdot(vnormalize(A_), vnormalize(B_)))))) #end
#macro VAngleD(A_, B_) (degrees(VAngle(A_, B_))) #end
#macro VRotation(A_, B_, Axis_) (VAngle(A_, B_) * (vdot(Axis_, vcross(A_, B_)) < 0 ? -1 : 1)) #end
#macro VRotationD(A_, B_, Axis_) (degrees(VRotation(A_, B_, Axis_))) #end
#macro VPerp_To_Vector(A_)
  #local Least_ = min(abs(A_.x), abs(A_.y), abs(A_.z));
  #local Other_ = (abs(A_.z) = Least_ ? z : abs(A_.y) = Least_ ? y : x);
  (vnormalize(vcross(A_, Other_)))
#end
#macro VPerp_To_Plane(A_, B_) (vnormalize(vcross(A_, B_))) #end
#macro VPerp_Adjust(A_, Axis_) (vnormalize(vcross(vcross(Axis_, A_), Axis_))) #end
#macro VProject_Plane(A_, Axis_) (A_ - vdot(A_, Axis_) / vdot(Axis_, Axis_) * Axis_) #end
#macro VProject_Axis(A_, Axis_) (vdot(A_, Axis_) / vdot(Axis_, Axis_) * Axis_) #end
)";

/// Glass without fading.
inline constexpr std::string_view glass_inc = R"(
#macro I_Glass_Exp(Distance_) ior 1.5 #end
#macro I_Glass_Sqr(Distance_) ior 1.5 #end
)";

inline constexpr std::string_view rand_inc = R"(
#macro Prob(P_, Stream_) (rand(Stream_) < P_) #end
#macro SRand(Stream_) (rand(Stream_) * 2 - 1) #end
#macro RRand(Min_, Max_, Stream_) (rand(Stream_) * (Max_ - Min_) + Min_) #end
#macro VRand(Stream_) (<rand(Stream_), rand(Stream_), rand(Stream_)>) #end
#macro VRand_In_Box(Min_, Max_, Stream_)
  (<rand(Stream_), rand(Stream_), rand(Stream_)> * (Max_ - Min_) + Min_)
#end
#macro VRand_On_Sphere(Stream_)
  #local Turn_ = 2 * pi * rand(Stream_);
  #local From_pole_ = acos(2 * rand(Stream_) - 1);
  (<cos(Turn_) * sin(From_pole_), sin(Turn_) * sin(From_pole_), cos(From_pole_)>)
#end
#macro VRand_In_Sphere(Stream_)
  #local Radius_ = pow(rand(Stream_), 1 / 3);
  (Radius_ * VRand_On_Sphere(Stream_))
#end
)";

} // namespace raylane::scenes::pov
