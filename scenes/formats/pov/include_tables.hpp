#pragma once

#include <string_view>

/// Numbers of the colours, finishes and textures in POV-Ray's own files, and the unsupported names
/// in them. A texture with a pattern has the mean of its colours.
namespace raylane::scenes::pov {

struct Inclusion {
    std::string_view file, includes;
};
struct NamesNotRead {
    std::string_view file, names;
};
/// Declarations that differ only by their numbers, which replace the '@'.
struct Table {
    std::string_view file, value, rows;
};

// clang-format off

inline constexpr Inclusion inclusions[] = {
    {"glass.inc", "glass_old.inc"},
    {"glass.inc", "consts.inc"},
    {"logo.inc", "shapes.inc"},
    {"math.inc", "functions.inc"},
    {"metals.inc", "golds.inc"},
    {"rand.inc", "consts.inc"},
    {"shapes.inc", "shapes_old.inc"},
    {"shapes.inc", "consts.inc"},
    {"shapes.inc", "transforms.inc"},
    {"shapes.inc", "strings.inc"},
    {"shapes.inc", "math.inc"},
    {"shapes3.inc", "shapes.inc"},
    {"shapes3.inc", "transforms.inc"},
    {"shapes3.inc", "math.inc"},
    {"shapes3.inc", "strings.inc"},
    {"stdinc.inc", "colors.inc"},
    {"stdinc.inc", "shapes.inc"},
    {"stdinc.inc", "transforms.inc"},
    {"stdinc.inc", "consts.inc"},
    {"stdinc.inc", "functions.inc"},
    {"stdinc.inc", "math.inc"},
    {"stdinc.inc", "rand.inc"},
    {"stoneold.inc", "stones1.inc"},
    {"stones.inc", "stones1.inc"},
    {"stones.inc", "stones2.inc"},
    {"textures.inc", "finish.inc"},
    {"transforms.inc", "math.inc"},
    {"woods.inc", "woodmaps.inc"},
};

inline constexpr NamesNotRead names_not_read[] = {
    {"arrays.inc",
     "Rand_Array_Item Resize_Array Reverse_Array Sort_Compare Sort_Swap_Data Sort_Array "
     "Sort_Partial_Array ARRAYS_QuickSortSeed ARRAYS_HybridQuickSortStep ARRAYS_InsertionSort "
     "ARRAYS_WriteDF3"},
    {"chars.inc",
     "char_A char_P char_B char_C char_D char_F char_E char_G char_H char_I char_J char_K char_L "
     "char_M char_N char_O char_Q char_R char_S char_T char_U char_V char_W char_X char_Y char_Z "
     "char_Dash char_Plus char_0 char_1 char_2 char_3 char_4 char_5 char_6 char_7 char_8 char_9 "
     "char_ExclPt char_AtSign char_Num char_Dol char_Perc char_Hat char_Amps char_Astr char_LPar "
     "char_RPar char_LSqu char_RSqu"},
    {"colors.inc",
     "CH2RGB CRGB2H CHSL2RGB CRGB2HSL CHSV2RGB CRGB2HSV"},
    {"debug.inc",
     "DEBUG_MCR DEBUG Debug_Inc_Stack Set_Debug Debug_Message Debug Warning Error"},
    {"functions.inc",
     "f_algbr_cyl1 f_algbr_cyl2 f_algbr_cyl3 f_algbr_cyl4 f_bicorn f_bifolia f_blob f_blob2 "
     "f_boy_surface f_comma f_cross_ellipsoids f_crossed_trough f_cubic_saddle f_cushion "
     "f_devils_curve f_devils_curve_2d f_dupin_cyclid f_ellipsoid f_enneper f_flange_cover "
     "f_folium_surface f_folium_surface_2d f_glob f_heart f_helical_torus f_helix1 f_helix2 "
     "f_hex_x f_hex_y f_hetero_mf f_hunt_surface f_hyperbolic_torus f_isect_ellipsoids "
     "f_kampyle_of_eudoxus f_kampyle_of_eudoxus_2d f_klein_bottle f_kummer_surface_v1 "
     "f_kummer_surface_v2 f_lemniscate_of_gerono f_lemniscate_of_gerono_2d f_mesh1 f_mitre "
     "f_nodal_cubic f_odd f_ovals_of_cassini f_paraboloid f_parabolic_torus f_ph f_pillow "
     "f_piriform f_piriform_2d f_poly4 f_polytubes f_quantum f_quartic_paraboloid "
     "f_quartic_saddle f_quartic_cylinder f_r f_ridge f_ridged_mf f_rounded_box f_sphere f_spikes "
     "f_spikes_2d f_spiral f_steiners_roman f_strophoid f_strophoid_2d f_superellipsoid f_th "
     "f_torus f_torus2 f_torus_gumdrop f_umbrella f_witch_of_agnesi f_witch_of_agnesi_2d "
     "f_noise3d f_snoise3d f_noise_generator eval_pigment f_agate f_boxed f_bozo f_brick f_bumps "
     "f_checker f_crackle f_cylindrical f_dents f_gradientX f_gradientY f_gradientZ f_granite "
     "f_hexagon f_leopard f_mandel f_marble f_onion f_planar f_radial f_ripples f_spherical "
     "f_spiral1 f_spiral2 f_spotted f_waves f_wood f_wrinkles f_sine_wave f_scallop_wave"},
    {"ior.inc",
     "FnPovDispersion Ior Disp"},
    {"logo.inc",
     "Povray_Logo Povray_Logo_Prism Povray_Logo_Bevel"},
    {"makegrass.inc",
     "MakeBlade MakeGrassPatch MakePrairie"},
    {"math.inc",
     "GetStats Histogram VPow5D VEq5D VZero5D VLength5D VNormalize5D VDot5D SetGradientAccuracy "
     "fn_Gradient fn_Gradient_Directional fn_Divergence vGradient vCurl Divergence "
     "Gradient_Length Gradient_Directional"},
    {"meshmaker.inc",
     "CheckFileName BuildSpline MSM EPS EPSNorm __FU __FV FromU ToU FromV ToV Parametric "
     "Paramcalc Prism Prism1 Lathe Coons TwoVarSurf FindPoint SweepSpline1 SweepSpline2"},
    {"rad_def.inc",
     "Rad_Settings"},
    {"rand.inc",
     "RdmA RdmB RdmC RdmD Gauss_Next Rand_Cauchy Rand_Student Rand_Normal Rand_Gauss Rand_Spline "
     "Rand_Gamma Rand_Beta Rand_Chi_Square Rand_F_Dist Rand_Triangle Rand_Erlang Rand_Exp "
     "Rand_Lognormal Rand_Pareto Rand_Weibull Rand_Bernoulli Rand_Binomial Rand_Geo Rand_Poisson "
     "VRand_In_Obj"},
    {"screen.inc",
     "Update_Camera Set_Camera_Location Set_Camera_Look_At Set_Camera_Aspect_Ratio "
     "Set_Camera_Aspect Set_Camera_Sky Set_Camera_Zoom Set_Camera_Angle Set_Camera Reset_Camera "
     "Screen_Object Screen_Plane"},
    {"shapes.inc",
     "Isect IsectN Extents Center_Object Align_Object Bevelled_Text Align_Left Align_Right "
     "Align_Center Text_Space Text_Width Circle_Text Circle_Text_Valigned Supertorus Supercone "
     "Round_Cylinder_Union Round_Cylinder_Merge Round_Cylinder Round_Cone_Union Round_Cone_Merge "
     "Round_Cone HF_Square HF_Sphere HF_Cylinder HF_Torus HFCreate_"},
    {"shapes3.inc",
     "Segment_of_Object Segment_of_CylinderRing Segment_of_Torus Round_N_Tube_Polygon Pyramid_N "
     "Pyramid_N_AB Column_N Column_N_AB Egg_Shape Egg Facetted_Sphere Facetted_Egg_Shape "
     "Facetted_Egg Ring_Sphere Round_Pyramid_N_in Round_Pyramid_N_out Rounded_Tube "
     "Rounded_Tube_AB Round_Cylinder_Tube Round_Conic_Torus Round_Conic_Prism "
     "Half_Hollowed_Rounded_Cylinder1 Half_Hollowed_Rounded_Cylinder2"},
    {"shapesq.inc",
     "Bicorn Crossed_Trough Cubic_Cylinder Cubic_Saddle_1 Devils_Curve Folium Glob_5 Twin_Glob "
     "Helix Helix_1 Hyperbolic_Torus_40_12 Lemniscate Quartic_Loop_1 Monkey_Saddle "
     "Parabolic_Torus_40_12 Piriform Quartic_Paraboloid Quartic_Cylinder Steiner_Surface "
     "Torus_40_12 Witch_Hat Sinsurf"},
    {"skies.inc",
     "O_Cloud1 O_Cloud2"},
    {"strings.inc",
     "CRGBFTStr CRGBStr Parse_String Str VStr2D VStr Vstr2D Vstr Triangle_Str Smooth_Triangle_Str"},
    {"sunpos.inc",
     "SunPos"},
    {"textures.inc",
     "Irregular_Bricks_Ptrn Hex_Tiles_Ptrn Tiles_Ptrn Star_Ptrn"},
    {"transforms.inc",
     "Axial_Scale_Trans Center_Trans Align_Trans Spline_Trans vtransform vinv_transform"},
};

inline constexpr Table tables[] = {
    {"colors.inc", "rgb <@>",
     "Aquamarine 0.439216 0.858824 0.576471; BakersChoc 0.36 0.2 0.09; Black 0 0 0; Blue 0 0 1; "
     "BlueViolet 0.62352 0.372549 0.623529; Brass 0.71 0.65 0.26; BrightGold 0.85 0.85 0.1; "
     "Bronze 0.55 0.47 0.14; Bronze2 0.65 0.49 0.24; Brown 0.647059 0.164706 0.164706; "
     "CadetBlue 0.372549 0.623529 0.623529; CoolCopper 0.85 0.53 0.1; Copper 0.72 0.45 0.2; "
     "Coral 1 0.498039 0; CornflowerBlue 0.258824 0.258824 0.435294; Cyan 0 1 1; "
     "DarkBrown 0.36 0.25 0.2; DarkGreen 0.184314 0.309804 0.184314; "
     "DarkOliveGreen 0.309804 0.309804 0.184314; DarkOrchid 0.6 0.196078 0.8; "
     "DarkPurple 0.53 0.12 0.47; DarkSlateBlue 0.119608 0.137255 0.556863; "
     "DarkSlateGray 0.184314 0.309804 0.309804; DarkSlateGrey 0.184314 0.309804 0.309804; "
     "DarkTan 0.59 0.41 0.31; DarkTurquoise 0.439216 0.576471 0.858824; DarkWood 0.52 0.37 0.26; "
     "DimGray 0.329412 0.329412 0.329412; DimGrey 0.329412 0.329412 0.329412; "
     "DkGreenCopper 0.29 0.46 0.43; DustyRose 0.52 0.39 0.39; Feldspar 0.82 0.57 0.46; "
     "Firebrick 0.556863 0.137255 0.137255; Flesh 0.96 0.8 0.69; "
     "ForestGreen 0.137255 0.556863 0.137255; Gold 0.8 0.498039 0.196078; "
     "Goldenrod 0.858824 0.858824 0.439216; Gray 0.752941 0.752941 0.752941; "
     "Gray05 0.05 0.05 0.05; Gray10 0.1 0.1 0.1; Gray15 0.15 0.15 0.15; Gray20 0.2 0.2 0.2; "
     "Gray25 0.25 0.25 0.25; Gray30 0.3 0.3 0.3; Gray35 0.35 0.35 0.35; Gray40 0.4 0.4 0.4; "
     "Gray45 0.45 0.45 0.45; Gray50 0.5 0.5 0.5; Gray55 0.55 0.55 0.55; Gray60 0.6 0.6 0.6; "
     "Gray65 0.65 0.65 0.65; Gray70 0.7 0.7 0.7; Gray75 0.75 0.75 0.75; Gray80 0.8 0.8 0.8; "
     "Gray85 0.85 0.85 0.85; Gray90 0.9 0.9 0.9; Gray95 0.95 0.95 0.95; Green 0 1 0; "
     "GreenCopper 0.32 0.49 0.46; GreenYellow 0.576471 0.858824 0.439216; "
     "Grey 0.752941 0.752941 0.752941; HuntersGreen 0.13 0.37 0.31; "
     "IndianRed 0.309804 0.184314 0.184314; Khaki 0.623529 0.623529 0.372549; "
     "LightBlue 0.74902 0.847059 0.847059; LightGray 0.658824 0.658824 0.658824; "
     "LightGrey 0.658824 0.658824 0.658824; LightSteelBlue 0.560784 0.560784 0.737255; "
     "LightWood 0.91 0.76 0.65; Light_Purple 0.87 0.58 0.98; LimeGreen 0.196078 0.8 0.196078; "
     "Magenta 1 0 1; MandarinOrange 0.89 0.47 0.2; Maroon 0.556863 0.137255 0.419608; "
     "Med_Purple 0.73 0.16 0.96; MediumAquamarine 0.196078 0.8 0.6; "
     "MediumBlue 0.196078 0.196078 0.8; MediumForestGreen 0.419608 0.556863 0.137255; "
     "MediumGoldenrod 0.917647 0.917647 0.678431; MediumOrchid 0.576471 0.439216 0.858824; "
     "MediumSeaGreen 0.258824 0.435294 0.258824; MediumSlateBlue 0.498039 0 1; "
     "MediumSpringGreen 0.498039 1 0; MediumTurquoise 0.439216 0.858824 0.858824; "
     "MediumVioletRed 0.858824 0.439216 0.576471; MediumWood 0.65 0.5 0.39; Mica 0 0 0; "
     "MidnightBlue 0.184314 0.184314 0.309804; Navy 0.137255 0.137255 0.556863; "
     "NavyBlue 0.137255 0.137255 0.556863; NeonBlue 0.3 0.3 1; NeonPink 1 0.43 0.78; "
     "NewMidnightBlue 0 0 0.61; NewTan 0.92 0.78 0.62; OldGold 0.81 0.71 0.23; Orange 1 0.5 0; "
     "OrangeRed 1 0.25 0; Orchid 0.858824 0.439216 0.858824; "
     "PaleGreen 0.560784 0.737255 0.560784; Pink 0.737255 0.560784 0.560784; "
     "Plum 0.917647 0.678431 0.917647; Quartz 0.85 0.85 0.95; Red 1 0 0; RichBlue 0.35 0.35 0.67; "
     "Salmon 0.435294 0.258824 0.258824; Scarlet 0.55 0.09 0.09; "
     "SeaGreen 0.137255 0.556863 0.419608; SemiSweetChoc 0.42 0.26 0.15; "
     "Sienna 0.556863 0.419608 0.137255; Silver 0.9 0.91 0.98; SkyBlue 0.196078 0.6 0.8; "
     "SlateBlue 0 0.498039 1; SpicyPink 1 0.11 0.68; SpringGreen 0 1 0.498039; "
     "SteelBlue 0.137255 0.419608 0.556863; SummerSky 0.22 0.69 0.87; "
     "Tan 0.858824 0.576471 0.439216; Thistle 0.847059 0.74902 0.847059; "
     "Turquoise 0.678431 0.917647 0.917647; VLightGray 0.8 0.8 0.8; VLightGrey 0.8 0.8 0.8; "
     "VeryDarkBrown 0.35 0.16 0.14; Very_Light_Purple 0.94 0.81 0.99; "
     "Violet 0.309804 0.184314 0.309804; VioletRed 0.8 0.196078 0.6; "
     "Wheat 0.847059 0.847059 0.74902; White 1 1 1; Yellow 1 1 0; YellowGreen 0.6 0.8 0.196078"},
    {"colors.inc", "rgbf <@>",
     "Clear 1 1 1 1"},
    {"consts.inc", "@",
     "Air_Ior 1.00029; Amethyst_Ior 1.55; Apatite_Ior 1.635; Aquamarine_Ior 1.575; "
     "Beryl_Ior 1.575; Bi 2; Citrine_Ior 1.55; Corundum_Ior 1.765; Crown_Glass_Ior 1.51; "
     "Cylinder_Map 2; Diamond_Dispersion 1.035; Diamond_Ior 2.47; Emerald_Ior 1.575; "
     "Flint_Glass_Heavy_Ior 1.8; Flint_Glass_Ior 1.71; Flint_Glass_Light_Ior 1.6; "
     "Flint_Glass_Medium_Ior 1.63; Fluorite_Ior 1.434; FoV_105 0.76737; FoV_120 0.577391; "
     "FoV_135 0.414254; FoV_15 7.59598; FoV_150 0.267991; FoV_165 0.131696; FoV_30 3.73217; "
     "FoV_45 2.41429; FoV_60 1.73211; FoV_75 1.30328; FoV_90 1.00005; Ground_Fog 2; "
     "Gypsum_Ior 1.525; HENYEY_GREENSTEIN_SCATTERING 5; Hex_Blur1 7; Hex_Blur2 19; Hex_Blur3 37; "
     "ISOTROPIC_SCATTERING 1; Ice_Ior 1.31; MIE_HAZY_SCATTERING 2; MIE_MURKY_SCATTERING 3; "
     "Norm 4; Plane_Map 0; Plexiglas_Ior 1.5; Quartz_Glass_Dispersion 1.012; "
     "Quartz_Glass_Ior 1.458; Quartz_Ior 1.55; RAYLEIGH_SCATTERING 4; Ruby_Ior 1.765; "
     "Salt_Ior 1.544; Sapphire_Dispersion 1.015; Sapphire_Ior 1.765; Sphere_Map 1; "
     "Topaz_Ior 1.62; Torus_Map 5; Tourmaline_Ior 1.65; Uniform_Fog 1; Water_Dispersion 1.007; "
     "Water_Ior 1.33; e 2.71828"},
    {"consts.inc", "<@>",
     "o 0 0 0; xy 1 1 0; xz 1 0 1; yz 0 1 1"},
    {"finish.inc", "finish { specular 0.5 roughness 0.15 }",
     "Dull"},
    {"finish.inc", "finish { specular 1 roughness 0.0001 reflection 0.13 }",
     "Glossy"},
    {"finish.inc", "finish { ambient 1 diffuse 0 }",
     "Luminous"},
    {"finish.inc", "finish { ambient 0 diffuse 0 reflection 1 }",
     "Mirror"},
    {"finish.inc", "finish { phong 0.5 phong_size 1 }",
     "Phong_Dull"},
    {"finish.inc", "finish { phong 1 phong_size 300 reflection 0.13 }",
     "Phong_Glossy"},
    {"finish.inc", "finish { phong 1 phong_size 200 }",
     "Phong_Shiny"},
    {"finish.inc", "finish { specular 1 roughness 0.001 }",
     "Shiny"},
    {"golds.inc", "finish { ambient 0.174 diffuse 0.391 brilliance 2 specular 0.2 reflection 0.435 metallic }",
     "F_MetalA"},
    {"golds.inc", "finish { ambient 0.1667 diffuse 0.35 brilliance 3 specular 0.3 roughness 0.01667 reflection 0.4833 metallic }",
     "F_MetalB"},
    {"golds.inc", "finish { ambient 0.1573 diffuse 0.306 brilliance 4 specular 0.6 roughness 0.0125 reflection 0.5367 metallic }",
     "F_MetalC"},
    {"golds.inc", "finish { ambient 0.1383 diffuse 0.2667 brilliance 5 specular 0.7 roughness 0.01 reflection 0.595 metallic }",
     "F_MetalD"},
    {"golds.inc", "finish { ambient 0.1163 diffuse 0.2253 brilliance 6 specular 0.8 roughness 0.008333 reflection 0.6583 metallic }",
     "F_MetalE"},
    {"golds.inc", "<@>",
     "GoldBase 1 0.875 0.575"},
    {"golds.inc", "rgb <@>",
     "P_Gold1 1 0.675 0.175; P_Gold2 1 0.725 0.275; P_Gold3 1 0.775 0.375; P_Gold4 1 0.825 0.475; "
     "P_Gold5 1 0.875 0.575"},
    {"metals.inc", "finish { ambient 0.35 diffuse 0.3 brilliance 2 specular 0.8 reflection 0.1 metallic }",
     "F_MetalA"},
    {"metals.inc", "finish { ambient 0.3 diffuse 0.4 brilliance 3 specular 0.7 roughness 0.01667 reflection 0.25 metallic }",
     "F_MetalB"},
    {"metals.inc", "finish { ambient 0.25 diffuse 0.5 brilliance 4 specular 0.8 roughness 0.0125 reflection 0.5 metallic }",
     "F_MetalC"},
    {"metals.inc", "finish { ambient 0.15 brilliance 5 specular 0.8 roughness 0.01 reflection 0.65 metallic }",
     "F_MetalD"},
    {"metals.inc", "finish { diffuse 0.7 brilliance 6 specular 0.8 roughness 0.008333 reflection 0.8 metallic }",
     "F_MetalE"},
    {"metals.inc", "rgb <@>",
     "P_Brass1 0.3 0.2 0.1; P_Brass2 0.5 0.35 0.25; P_Brass3 0.58 0.42 0.2; "
     "P_Brass4 0.65 0.5 0.25; P_Brass5 0.7 0.55 0.4; P_Chrome1 0.2 0.2 0.2; "
     "P_Chrome2 0.39 0.41 0.43; P_Chrome3 0.5 0.5 0.5; P_Chrome4 0.75 0.75 0.75; "
     "P_Chrome5 0.95 0.95 0.95; P_Copper1 0.4 0.2 0.15; P_Copper2 0.5 0.25 0.15; "
     "P_Copper3 0.6 0.3 0.15; P_Copper4 0.7 0.25 0.15; P_Copper5 0.65 0.35 0.15; "
     "P_Silver1 0.94 0.93 0.8; P_Silver2 0.94 0.93 0.85; P_Silver3 0.94 0.93 0.9; "
     "P_Silver4 0.95 0.91 0.91; P_Silver5 0.91 0.95 0.91"},
    {"glass_old.inc", "finish { ambient 0 diffuse 0 specular 1 roughness 0.001 reflection 0.1 }",
     "F_Glass1"},
    {"glass_old.inc", "finish { ambient 0 diffuse 0 phong 0.3 phong_size 60 reflection 0.5 }",
     "F_Glass2"},
    {"glass_old.inc", "finish { diffuse 0.1 phong 1 phong_size 400 specular 0.8 roughness 0.003 reflection 0.1 }",
     "F_Glass3"},
    {"glass_old.inc", "finish { diffuse 0.1 specular 1 roughness 0.001 reflection 0.25 }",
     "F_Glass4"},
    {"glass_old.inc", "interior { ior @ }",
     "I_Glass 1.5"},
    {"glass_old.inc", "texture { pigment { rgbf <@> } finish { diffuse 0.1 specular 1 roughness 0.001 reflection 0.25 } }",
     "T_Beerbottle_Glass 0.7 0.5 0.1 0.6; T_Dark_Green_Glass 0.1 0.7 0.8 0.8; "
     "T_Glass4 0.98 1 0.99 0.75; T_Old_Glass 0.8 0.9 0.85 0.85; T_Orange_Glass 1 0.5 0 0.8; "
     "T_Ruby_Glass 0.9 0.1 0.2 0.8; T_Vicksbottle_Glass 0.1 0.15 0.5 0.9; "
     "T_Winebottle_Glass 0.4 0.72 0.4 0.6; T_Yellow_Glass 0.8 0.8 0.2 0.8"},
    {"glass_old.inc", "texture { pigment { rgbf <@> } finish { ambient 0 diffuse 0 specular 1 roughness 0.001 reflection 0.1 } }",
     "T_Glass1 1 1 1 0.7"},
    {"glass_old.inc", "texture { pigment { rgbf <@> } finish { ambient 0 diffuse 0 phong 0.3 phong_size 60 reflection 0.5 } }",
     "T_Glass2 1 1 1 1"},
    {"glass_old.inc", "texture { pigment { rgbf <@> } finish { diffuse 0.1 phong 1 phong_size 400 specular 0.8 roughness 0.003 reflection 0.1 } }",
     "T_Glass3 0.98 0.98 0.98 0.9; T_Green_Glass 0.8 1 0.95 0.9"},
    {"glass.inc", "rgb <@>",
     "Col_Amber_01 0.3725 0.4235 0.2941; Col_Amber_02 0.8941 0.6863 0.2902; "
     "Col_Amber_03 0.7412 0.4235 0.2588; Col_Amber_04 0.7059 0.3961 0.1216; "
     "Col_Amber_05 0.5647 0.2392 0.0745; Col_Amber_06 0.8157 0.6549 0.2392; "
     "Col_Amber_07 0.9882 0.6941 0.0431; Col_Amber_08 0.8549 0.4706 0.1294; "
     "Col_Amber_09 0.5294 0.2431 0.1529; Col_Amethyst_01 0.4392 0.1765 0.3137; "
     "Col_Amethyst_02 0.5843 0.3686 0.4941; Col_Amethyst_03 0.698 0.5059 0.6157; "
     "Col_Amethyst_04 0.9059 0.7176 0.8471; Col_Amethyst_05 0.8902 0.4549 0.7059; "
     "Col_Amethyst_06 0.498 0.2902 0.4235; Col_Apatite_01 0.0549 0.3451 0.4314; "
     "Col_Apatite_02 0.2941 0.5765 0.5647; Col_Apatite_03 0.5176 0.7333 0.702; "
     "Col_Apatite_04 0.3412 0.5961 0.4118; Col_Apatite_05 0.3647 0.8196 0.7451; "
     "Col_Aquamarine_01 0.5333 0.6157 0.6196; Col_Aquamarine_02 0.6627 0.702 0.7255; "
     "Col_Aquamarine_03 0.7412 0.8235 0.8431; Col_Aquamarine_04 0.6039 0.7216 0.7882; "
     "Col_Aquamarine_05 0.5804 0.7098 0.7765; Col_Aquamarine_06 0.7255 0.851 0.9176; "
     "Col_Azurite_01 0.2863 0.3569 0.7216; Col_Azurite_02 0.5333 0.6549 0.9059; "
     "Col_Azurite_03 0.302 0.3529 0.6314; Col_Azurite_04 0.1137 0.1569 0.4471; "
     "Col_Beerbottle 0.7 0.5 0.1; Col_Blue_01 0.35 0.42 0.85; Col_Blue_02 0.35 0.65 0.85; "
     "Col_Blue_03 0.35 0.4 0.75; Col_Blue_04 0.1 0.1 0.5; Col_Citrine_01 0.302 0.2314 0.1529; "
     "Col_Citrine_02 0.4667 0.3804 0.298; Col_Citrine_03 0.502 0.4118 0.3529; "
     "Col_Dark_Green 0.1 0.7 0.8; Col_Emerald_01 0.0471 0.4 0.2549; "
     "Col_Emerald_02 0.2157 0.6353 0.4902; Col_Emerald_03 0.3216 0.6627 0.5961; "
     "Col_Emerald_04 0.1843 0.4549 0.3843; Col_Emerald_05 0.2863 0.6431 0.4431; "
     "Col_Emerald_06 0.2353 0.5922 0.3804; Col_Emerald_07 0.4392 0.7725 0.5804; "
     "Col_Fluorite_01 0.5098 0.3294 0.4039; Col_Fluorite_02 0.302 0.1569 0.2431; "
     "Col_Fluorite_03 0.5098 0.2902 0.2745; Col_Fluorite_04 0.5373 0.3098 0.0902; "
     "Col_Fluorite_05 0.702 0.5529 0.7294; Col_Fluorite_06 0.4745 0.2627 0.4824; "
     "Col_Fluorite_07 0.2314 0.0784 0.2902; Col_Fluorite_08 0.5804 0.6235 0.6745; "
     "Col_Fluorite_09 0.4392 0.4745 0.5333; Col_Green 0.8 1 0.95; Col_Green_01 0.1 0.85 0.2; "
     "Col_Green_02 0.35 0.85 0.1; Col_Green_03 0.2 0.75 0.25; Col_Green_04 0.1 0.5 0.1; "
     "Col_Gypsum_01 0.902 0.8824 0.7882; Col_Gypsum_02 0.8039 0.8667 0.8157; "
     "Col_Gypsum_03 0.7098 0.6863 0.6; Col_Gypsum_04 0.8275 0.8078 0.5765; "
     "Col_Gypsum_05 0.8196 0.7373 0.5294; Col_Gypsum_06 0.5961 0.4941 0.302; Col_Orange 1 0.5 0; "
     "Col_Red_01 0.85 0.1 0.2; Col_Red_02 0.85 0.35 0.1; Col_Red_03 0.75 0.2 0.25; "
     "Col_Red_04 0.5 0.1 0.1; Col_Ruby 0.9 0.1 0.2; Col_Ruby_01 0.498 0.0824 0.2275; "
     "Col_Ruby_02 0.6235 0.149 0.3137; Col_Ruby_03 0.7412 0.3294 0.4745; "
     "Col_Ruby_04 0.8039 0.2039 0.5569; Col_Ruby_05 0.5882 0.1255 0.4784; "
     "Col_Sapphire_01 0.2118 0.302 0.498; Col_Sapphire_02 0.0588 0.2 0.5569; "
     "Col_Sapphire_03 0.0392 0.2353 0.5686; Col_Topaz_01 0.7333 0.7451 0.698; "
     "Col_Topaz_02 0.5922 0.6196 0.5922; Col_Topaz_03 0.5922 0.6157 0.651; "
     "Col_Tourmaline_01 0.3725 0.4235 0.2941; Col_Tourmaline_02 0.2745 0.349 0.2235; "
     "Col_Tourmaline_03 0.2627 0.2549 0.1451; Col_Tourmaline_04 0.1333 0.4706 0.3412; "
     "Col_Tourmaline_05 0.0627 0.298 0.2118; Col_Tourmaline_06 0.0196 0.2706 0.1961; "
     "Col_Vicksbottle 0.1 0.15 0.5; Col_Winebottle 0.4 0.72 0.4; Col_Yellow 0.8 0.8 0.2; "
     "Col_Yellow_01 0.85 0.85 0.2; Col_Yellow_02 0.75 0.78 0.1; Col_Yellow_03 0.78 0.75 0.1; "
     "Col_Yellow_04 0.5 0.5 0.1"},
    {"glass.inc", "rgbf <@>",
     "Col_Glass_Beerbottle 0.7 0.5 0.1 0.6; Col_Glass_Bluish 0.9 0.94 1 0.8; "
     "Col_Glass_Clear 1 1 1 1; Col_Glass_Dark_Green 0.1 0.7 0.8 0.8; "
     "Col_Glass_General 0.97 0.99 0.98 0.9; Col_Glass_Green 0.8 1 0.95 0.9; "
     "Col_Glass_Old 0.8 0.9 0.85 0.85; Col_Glass_Orange 1 0.5 0 0.8; "
     "Col_Glass_Ruby 0.9 0.1 0.2 0.8; Col_Glass_Vicksbottle 0.1 0.15 0.5 0.9; "
     "Col_Glass_Winebottle 0.4 0.72 0.4 0.6; Col_Glass_Yellow 0.8 0.8 0.2 0.8"},
    {"glass.inc", "finish { ambient 0 diffuse 0.1 specular 0.6 roughness 0.002 reflection 0.525 }",
     "F_Glass10"},
    {"glass.inc", "finish { ambient 0 diffuse 0 specular 0.7 roughness 0.001 reflection { 1 fresnel } }",
     "F_Glass5"},
    {"glass.inc", "finish { ambient 0 diffuse 0.1 brilliance 5 specular 0.6 roughness 0.002 reflection { 1 fresnel } }",
     "F_Glass6"},
    {"glass.inc", "finish { ambient 0 diffuse 0 specular 0.9 roughness 0.001 reflection { 1 fresnel } }",
     "F_Glass7"},
    {"glass.inc", "finish { ambient 0 diffuse 0.15 brilliance 4 specular 0.6 roughness 0.005 reflection { 1 fresnel } }",
     "F_Glass8"},
    {"glass.inc", "finish { ambient 0 diffuse 0 specular 0.8 roughness 0.001 reflection 0.525 }",
     "F_Glass9"},
    {"glass.inc", "interior { ior @ }",
     "I_Glass1 1.5; I_Glass2 1.5; I_Glass3 1.5; I_Glass4 1.5; I_Glass_Caustics1 1.5; "
     "I_Glass_Caustics2 1.5; I_Glass_Dispersion1 1.5; I_Glass_Dispersion2 1.5; "
     "I_Glass_Fade_Exp1 1.5; I_Glass_Fade_Exp2 1.5; I_Glass_Fade_Exp3 1.5; I_Glass_Fade_Sqr1 1.5"},
    {"textures.inc", "texture { pigment { rgb <@> } finish { diffuse 0.65 brilliance 1.5 specular 0.85 roughness 0.01 reflection 0.45 } }",
     "Aluminum 0.55 0.5 0.45; Bright_Bronze 0.36 0.28 0.2; Gold_Nugget 0.5 0.35 0.25; "
     "New_Penny 0.6 0.45 0.4; Tinny_Brass 0.7 0.56 0.37"},
    {"textures.inc", "pigment { bozo color_map { [0 rgb <@>] } }",
     "Apocalypse 0.28 0 0.18; Blood_Sky 0.615 0.2712 0; Blue_Sky 0.3725 0.3725 0.51; "
     "Bright_Blue_Sky 0.625 0.625 0.9; Candy_Cane 1 0.5 0.5; X_Gradient 0.67 0.505 0.835; "
     "Y_Gradient 0.335 0.335 0.33"},
    {"textures.inc", "pigment { marble color_map { [0 rgb <@>] } }",
     "Blood_Marble 0.06 0.27 0.27; Jade 0.05 0.44 0.05; Red_Marble 0.8 0.54 0.46; "
     "White_Marble 0.63 0.63 0.63"},
    {"textures.inc", "color_map { [0 rgb <@>] }",
     "Blood_Marble_Map 0.06 0.27 0.27; Blue_Agate_Map 0.2462 0.2462 0.4098; "
     "Blue_Sky_Map 0.3725 0.3725 0.51; Brown_Agate_Map 0.635 0.465 0.32; Jade_Map 0.05 0.44 0.05; "
     "Pink_Granite_Map 0.5088 0.365 0.2812; Red_Marble_Map 0.8 0.54 0.46; "
     "Sapphire_Agate_Map 0 0 0.675; White_Marble_Map 0.63 0.63 0.63"},
    {"textures.inc", "pigment { agate color_map { [0 rgb <@>] } }",
     "Blue_Agate 0.2462 0.2462 0.4098; Blue_Sky2 0.35 0.35 1; Brown_Agate 0.635 0.465 0.32; "
     "Sapphire_Agate 0 0 0.675"},
    {"textures.inc", "pigment { granite color_map { [0 rgb <@>] } }",
     "Blue_Sky3 0.35 0.35 1; Pink_Granite 0.5088 0.365 0.2812"},
    {"textures.inc", "texture { pigment { rgb <@> } finish { ambient 0.2 diffuse 0.7 brilliance 6 phong 0.75 phong_size 80 reflection 0.25 } }",
     "Brass_Metal 0.71 0.65 0.26; Brass_Texture 0.71 0.65 0.26; Bronze_Metal 0.55 0.47 0.14; "
     "Bronze_Texture 0.55 0.47 0.14; Copper_Metal 0.72 0.45 0.2; Copper_Texture 0.72 0.45 0.2; "
     "Gold_Metal 0.85 0.85 0.1; Gold_Texture 0.85 0.85 0.1; Silver_Metal 0.9 0.91 0.98; "
     "Silver_Texture 0.9 0.91 0.98"},
    {"textures.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { brilliance 6 phong 0.75 reflection 0.75 } }",
     "Brass_Valley 0.7075 0.5825 0.5625"},
    {"textures.inc", "texture { pigment { rgb <@> } finish { ambient 0.3 diffuse 0.7 brilliance 8 specular 0.8 roughness 0.1 reflection 0.15 } }",
     "Brushed_Aluminum 0.6588 0.6588 0.6588; Chrome_Metal 0.6588 0.6588 0.6588; "
     "Chrome_Texture 0.6588 0.6588 0.6588"},
    {"textures.inc", "pigment { wood color_map { [0 rgb <@>] } }",
     "Cherry_Wood 0.588 0.267 0.169; DMFDarkOak 0.45 0.225 0.135; DMFLightOak 0.47 0.315 0.205; "
     "DMFWood1 0.45 0.225 0.135; DMFWood2 0.47 0.315 0.205; DMFWood3 0.3 0.099 0.0495; "
     "DMFWood4 0.744 0.5 0.25; DMFWood5 0.275 0.085 0.044; Dark_Wood 0.404 0.228 0.049; "
     "Pine_Wood 0.89 0.666 0.209; Tan_Wood 0.804 0.55 0.28; Tom_Wood 0.65 0.27 0; "
     "White_Wood 0.894 0.701 0.502"},
    {"textures.inc", "pigment { bozo color_map { [0 rgbft <@>] } }",
     "Clouds 0.94 0.94 0.94 0 0.7; FBM_Clouds 0.93 0.93 0.93 0 0.7"},
    {"textures.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { specular 0.1 roughness 0.5 } }",
     "Cork 0.8868 0.695 0.4914"},
    {"textures.inc", "texture { pigment { wood color_map { [0 rgb <@>] } } finish { ambient 0.45 diffuse 0.33 specular 0.25 reflection 0.15 } }",
     "DMFWood6 0.731 0.4825 0.3125"},
    {"textures.inc", "texture { pigment { rgbf <@> } finish { diffuse 0.1 specular 1 roughness 0.001 reflection 0.25 } }",
     "Dark_Green_Glass 0.1 0.7 0.8 0.8; NBbeerbottle 0.7 0.5 0.1 0.6; NBglass 0.98 1 0.99 0.75; "
     "NBoldglass 0.8 0.9 0.85 0.85; NBwinebottle 0.4 0.72 0.4 0.6; Orange_Glass 1 0.5 0 0.8; "
     "Ruby_Glass 0.9 0.1 0.2 0.8; Vicks_Bottle_Glass 0.1 0.15 0.5 0.9; "
     "Yellow_Glass 0.8 0.8 0.2 0.8"},
    {"textures.inc", "texture { pigment { wood color_map { [0 rgb <@>] } } finish { ambient 0.32 diffuse 0.63 phong 0.2 phong_size 10 } }",
     "EMBWood1 0.5657 0.4258 0.2731"},
    {"textures.inc", "texture { pigment { rgbf <@> } finish { ambient 0 diffuse 0 specular 1 roughness 0.001 reflection 0.1 } }",
     "Glass 1 1 1 0.7"},
    {"textures.inc", "texture { pigment { rgbf <@> } finish { ambient 0 diffuse 0 phong 0.3 phong_size 60 reflection 0.5 } }",
     "Glass2 1 1 1 1"},
    {"textures.inc", "texture { pigment { rgbf <@> } finish { diffuse 0.1 phong 1 phong_size 400 specular 0.8 roughness 0.0003 reflection 0.1 } }",
     "Glass3 0.98 0.98 0.98 0.9; Green_Glass 0.8 1 0.95 0.9"},
    {"textures.inc", "finish { ambient 0 diffuse 0 specular 1 roughness 0.001 reflection 0.1 }",
     "Glass_Finish"},
    {"textures.inc", "interior { ior @ }",
     "Glass_Interior 1.5; Water_Int 1.33"},
    {"textures.inc", "texture { pigment { marble color_map { [0 rgbf <@>] } } finish { ambient 1 } }",
     "Lightning1 0.8133 0.416 0.972 0.8037"},
    {"textures.inc", "texture { pigment { granite color_map { [0 rgbf <@>] } } finish { ambient 1 } }",
     "Lightning2 0.8275 0.458 0.974 0.8125"},
    {"textures.inc", "color_map { [0 rgbft <@>] }",
     "Lightning_CMap1 0.8133 0.416 0.972 0.8037 0; Lightning_CMap2 0.8275 0.458 0.974 0.8125 0"},
    {"textures.inc", "material { texture { pigment { rgbf <@> } finish { diffuse 0.1 specular 1 roughness 0.001 reflection 0.25 } } interior { ior 1.5 } }",
     "M_Dark_Green_Glass 0.1 0.7 0.8 0.8; M_NB_Beerbottle_Glass 0.7 0.5 0.1 0.6; "
     "M_NB_Glass 0.98 1 0.99 0.75; M_NB_Old_Glass 0.8 0.9 0.85 0.85; "
     "M_NB_Winebottle_Glass 0.4 0.72 0.4 0.6; M_Orange_Glass 1 0.5 0 0.8; "
     "M_Ruby_Glass 0.9 0.1 0.2 0.8; M_Vicks_Bottle_Glass 0.1 0.15 0.5 0.9; "
     "M_Yellow_Glass 0.8 0.8 0.2 0.8"},
    {"textures.inc", "material { texture { pigment { rgbf <@> } finish { ambient 0 diffuse 0 specular 1 roughness 0.001 reflection 0.1 } } interior { ior 1.5 } }",
     "M_Glass 1 1 1 0.7"},
    {"textures.inc", "material { texture { pigment { rgbf <@> } finish { ambient 0 diffuse 0 phong 0.3 phong_size 60 reflection 0.5 } } interior { ior 1.5 } }",
     "M_Glass2 1 1 1 1"},
    {"textures.inc", "material { texture { pigment { rgbf <@> } finish { diffuse 0.1 phong 1 phong_size 400 specular 0.8 roughness 0.0003 reflection 0.1 } } interior { ior 1.5 } }",
     "M_Glass3 0.98 0.98 0.98 0.9; M_Green_Glass 0.8 1 0.95 0.9"},
    {"textures.inc", "material { texture { pigment { ripples color_map { [0 rgbf <@>] } } finish { reflection { 1 fresnel } } } interior { ior 1.33 } }",
     "M_Water 0 0 1 0.9"},
    {"textures.inc", "finish { ambient 0.2 diffuse 0.7 brilliance 6 phong 0.75 phong_size 80 reflection 0.25 }",
     "Metal"},
    {"textures.inc", "finish { diffuse 0.65 brilliance 1.5 specular 0.85 roughness 0.01 reflection 0.45 }",
     "Metallic_Finish"},
    {"textures.inc", "texture { pigment { rgb <@> } finish { ambient 0.35 diffuse 1 brilliance 15 phong 0.41 phong_size 5 } }",
     "New_Brass 0.7 0.56 0.37; Spun_Brass 0.7 0.56 0.37"},
    {"textures.inc", "pigment { bozo color_map { [0 rgbf <@>] } }",
     "Peel 1 0.75 0.5 0.5"},
    {"textures.inc", "texture { pigment { bozo color_map { [0 rgb <@>] } } finish { ambient 0.25 } }",
     "PinkAlabaster 0.672 0.5743 0.5876"},
    {"textures.inc", "texture { pigment { rgb <@> } finish { diffuse 0.8 brilliance 6 phong 0.8 phong_size 120 reflection 0.4 } }",
     "Polished_Brass 0.578 0.422 0.195"},
    {"textures.inc", "texture { pigment { rgb <@> } finish { diffuse 0.7 brilliance 6 phong 0.8 phong_size 120 reflection 0.6 } }",
     "Polished_Chrome 0.2 0.2 0.2"},
    {"textures.inc", "texture { pigment { bozo color_map { [0 rgb <@>] } } finish { ambient 0.5 diffuse 0.8 } }",
     "Rosewood 0.2738 0.158 0.1131"},
    {"textures.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { ambient 0.2 diffuse 0.4 } }",
     "Rust 0.7225 0.355 0.19"},
    {"textures.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { ambient 0.2 } }",
     "Rusty_Iron 0.405 0.29 0.146"},
    {"textures.inc", "texture { pigment { bozo color_map { [0 rgb <@>] } } }",
     "Sandalwood 0.6774 0.5931 0.4362"},
    {"textures.inc", "texture { pigment { bozo color_map { [0 rgb <@>] } } finish { ambient 0.7 diffuse 0 } }",
     "Shadow_Clouds 0.5704 0.7683 0.8663"},
    {"textures.inc", "texture { pigment { rgb <@> } finish { ambient 0.25 diffuse 0.65 brilliance 6 phong 1 phong_size 100 reflection 0.45 } }",
     "Silver1 0.94 0.93 0.83; Silver2 0.94 0.93 0.86; Silver3 0.94 0.93 0.9"},
    {"textures.inc", "rgb <@>",
     "Silver1_Colour 0.94 0.93 0.83; Silver2_Colour 0.94 0.93 0.86; Silver3_Colour 0.94 0.93 0.9"},
    {"textures.inc", "finish { ambient 0.25 diffuse 0.65 brilliance 6 phong 1 phong_size 100 reflection 0.45 }",
     "SilverFinish"},
    {"textures.inc", "texture { pigment { rgb <@> } finish { ambient 0.2 diffuse 0.35 brilliance 1.5 specular 0.85 roughness 0.01 reflection 0.45 } }",
     "Soft_Silver 0.94 0.93 0.83"},
    {"textures.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { ambient 1 } }",
     "Starfield 0.1385 0.1385 0.1385"},
    {"textures.inc", "texture { pigment { ripples color_map { [0 rgbf <@>] } } finish { reflection { 1 fresnel } } }",
     "Water 0 0 1 0.9"},
    {"textures.inc", "texture { pigment { wood color_map { [0 rgb <@>] } } }",
     "Yellow_Pine 0.7707 0.6202 0.2706"},
    {"woodmaps.inc", "color_map { [0 rgb <@>] }",
     "M_Wood10A 0.94 0.76 0.476; M_Wood11A 0.7436 0.5865 0.1986; M_Wood12A 0.2832 0.1482 0.1057; "
     "M_Wood13A 0.735 0.485 0.245; M_Wood14A 0.625 0.1735 0.0875; M_Wood15A 0.2977 0.1804 0.0491; "
     "M_Wood16A 0.2977 0.1804 0.0491; M_Wood17A 0.3868 0.2351 0.1082; M_Wood18A 0.594 0.2754 0; "
     "M_Wood19A 0.8 0.4 0.2; M_Wood1A 0.74 0.45 0.3; M_Wood2A 0.1998 0.1105 0.0815; "
     "M_Wood3A 0.7275 0.605 0.4275; M_Wood4A 0.37 0.15 0.15; M_Wood5A 0.535 0.385 0.1; "
     "M_Wood6A 0.3725 0.1175 0.1; M_Wood7A 0.735 0.485 0.245; M_Wood8A 0.3775 0.2325 0.105; "
     "M_Wood9A 0.76 0.58 0.296"},
    {"woodmaps.inc", "color_map { [0 rgbft <@>] }",
     "M_Wood10B 0.91 0.57 0.28 0 0.56; M_Wood11B 0.8641 0.7496 0.5968 0 0.8188; "
     "M_Wood12B 0.5115 0.3494 0.2727 0 0.9295; M_Wood13B 0.945 0.8075 0.615 0 0.6; "
     "M_Wood14B 0.4025 0.1326 0.06825 0 0.62; M_Wood15B 0.432 0.221 0.08841 0 0.409; "
     "M_Wood16B 0.432 0.221 0.08841 0 0.381; M_Wood17B 0.4346 0.224 0.08955 0 0.283; "
     "M_Wood18B 0.5346 0.2757 0.1375 0 0.5495; M_Wood19B 0.9025 0.8013 0.7506 0.7 0; "
     "M_Wood1B 0.702 0.4255 0.28 0 0.745; M_Wood2B 0.5 0.2775 0.1775 0 0.7288; "
     "M_Wood3B 0.7225 0.645 0.49 0 0.7788; M_Wood4B 0.35 0.155 0.172 0 0.2225; "
     "M_Wood5B 0.3775 0.215 0.1225 0 0.835; M_Wood6B 0.3725 0.1175 0.1 0 0.4; "
     "M_Wood7B 0.945 0.8075 0.615 0 0.6; M_Wood8B 0.7 0.5125 0.4 0 0.725; "
     "M_Wood9B 0.7 0.46 0.136 0 0.63"},
    {"woods.inc", "pigment { wood color_map { [0 rgb <@>] } }",
     "P_WoodGrain10A 0 0 0; P_WoodGrain10B 0 0 0; P_WoodGrain11A 0 0 0; P_WoodGrain11B 0 0 0; "
     "P_WoodGrain12B 0 0 0; P_WoodGrain13A 0 0 0; P_WoodGrain13B 0 0 0; "
     "P_WoodGrain14A 0.625 0.1735 0.0875; P_WoodGrain17A 0.3868 0.2351 0.1082; "
     "P_WoodGrain18A 0.594 0.2754 0; P_WoodGrain19A 0.8 0.4 0.2; P_WoodGrain1A 0 0 0; "
     "P_WoodGrain1B 0 0 0; P_WoodGrain2A 0 0 0; P_WoodGrain2B 0 0 0; P_WoodGrain3A 0 0 0; "
     "P_WoodGrain3B 0 0 0; P_WoodGrain4A 0 0 0; P_WoodGrain5A 0 0 0; P_WoodGrain5B 0 0 0; "
     "P_WoodGrain6A 0 0 0; P_WoodGrain6B 0 0 0; P_WoodGrain7A 0 0 0; P_WoodGrain8A 0 0 0; "
     "P_WoodGrain8B 0 0 0; P_WoodGrain9A 0 0 0; P_WoodGrain9B 0 0 0"},
    {"woods.inc", "pigment { bozo color_map { [0 rgb <@>] } }",
     "P_WoodGrain12A 0 0 0; P_WoodGrain15A 0.2977 0.1804 0.0491; "
     "P_WoodGrain16A 0.2977 0.1804 0.0491; P_WoodGrain4B 0 0 0; P_WoodGrain7B 0 0 0"},
    {"woods.inc", "pigment { wood color_map { [0 rgbft <@>] } }",
     "P_WoodGrain14B 0.4025 0.1326 0.06825 0 0.62; P_WoodGrain15B 0.432 0.221 0.08841 0 0.409; "
     "P_WoodGrain16B 0.432 0.221 0.08841 0 0.381; P_WoodGrain17B 0.4346 0.224 0.08955 0 0.283; "
     "P_WoodGrain18B 0.5346 0.2757 0.1375 0 0.5495"},
    {"woods.inc", "pigment { bozo color_map { [0 rgbf <@>] } }",
     "P_WoodGrain19B 0.9025 0.8013 0.7506 0.7"},
    {"woods.inc", "texture { pigment { wood color_map { [0 rgb <@>] } } }",
     "T_Wood1 0.7303 0.4438 0.2949; T_Wood10 0.9268 0.6764 0.3898; T_Wood11 0.7654 0.6161 0.2707; "
     "T_Wood13 0.819 0.614 0.393; T_Wood14 0.5404 0.1579 0.08019; T_Wood17 0.4211 0.2271 0.09483; "
     "T_Wood18 0.5673 0.2756 0.06194; T_Wood19 0.7762 0.4647 0.3303; "
     "T_Wood2 0.2812 0.1558 0.1075; T_Wood20 0.7762 0.4647 0.3303; T_Wood21 0.7654 0.6161 0.2707; "
     "T_Wood22 0.2993 0.1624 0.1175; T_Wood23 0.819 0.614 0.393; T_Wood24 0.5404 0.1579 0.08019; "
     "T_Wood25 0.3771 0.2044 0.07233; T_Wood26 0.3808 0.2055 0.07343; "
     "T_Wood27 0.4211 0.2271 0.09483; T_Wood28 0.5673 0.2756 0.06194; "
     "T_Wood29 0.7762 0.4647 0.3303; T_Wood3 0.7264 0.6139 0.4413; T_Wood30 0.7303 0.4438 0.2949; "
     "T_Wood31 0.6107 0.4262 0.1883; T_Wood32 0.3191 0.08573 0; T_Wood33 0.4391 0.1734 0.001705; "
     "T_Wood35 0.85 0.4219 0.07571; T_Wood4 0.3544 0.1539 0.1671; T_Wood5 0.509 0.3569 0.1037; "
     "T_Wood6 0.3725 0.1175 0.1; T_Wood7 0.819 0.614 0.393; T_Wood8 0.4662 0.3095 0.1861; "
     "T_Wood9 0.7378 0.5356 0.2368"},
    {"woods.inc", "texture { pigment { bozo color_map { [0 rgb <@>] } } }",
     "T_Wood12 0.2993 0.1624 0.1175; T_Wood15 0.3771 0.2044 0.07233; "
     "T_Wood16 0.3808 0.2055 0.07343"},
    {"woods.inc", "texture { pigment { onion color_map { [0 rgb <@>] } } }",
     "T_Wood34 0.563 0.2417 0.03192"},
    {"stones1.inc", "texture { pigment { marble color_map { [0 rgbft <@>] } } }",
     "T_Crack1 0.4089 0.195 0.195 0 0.851; T_Crack3 0.1714 0.2881 0.1714 0 0.851; "
     "T_Crack4 0.2148 0.2148 0.2148 0 0.8"},
    {"stones1.inc", "texture { pigment { granite color_map { [0 rgbf <@>] } } }",
     "T_Crack2 0.98 0.98 0.98 0.98; T_Grnt22 0.8223 0.8223 0.8223 0.6"},
    {"stones1.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } }",
     "T_Grnt0 0.7712 0.6515 0.579; T_Grnt1 0.9337 0.9253 0.8234; T_Grnt12 0.9314 0.7529 0.6607; "
     "T_Grnt13 0.9785 0.7233 0.6666; T_Grnt14 0.7469 0.6421 0.5886; "
     "T_Grnt15 0.1175 0.09013 0.0806; T_Grnt16 0.85 0.8134 0.7817; "
     "T_Grnt17 0.0979 0.2101 0.08303; T_Grnt18 0.956 0.7395 0.6126; T_Grnt19 0.43 0.43 0.43; "
     "T_Grnt2 0.9087 0.7975 0.6677; T_Grnt20 0.85 0.85 0.85; T_Grnt26 0.9243 0.8252 0.7753; "
     "T_Grnt27 0.4038 0.3286 0.2425; T_Grnt3 0.8798 0.7385 0.67; T_Grnt4 0.8356 0.6658 0.5359; "
     "T_Grnt5 0.8117 0.6341 0.5381; T_Grnt6 0.6402 0.4983 0.4055; T_Grnt7 0.4988 0.3715 0.2866; "
     "T_Grnt8 0.8734 0.7366 0.6654; T_Grnt9 0.7369 0.7342 0.7434; T_Stone1 0.5954 0.4709 0.3904; "
     "T_Stone10 0.5007 0.4381 0.4052; T_Stone11 0.6384 0.501 0.4366; "
     "T_Stone19 0.9353 0.8505 0.8078; T_Stone2 0.7041 0.5828 0.5065; "
     "T_Stone20 0.5768 0.4729 0.4229; T_Stone22 0.5875 0.5182 0.4887; "
     "T_Stone3 0.7973 0.6403 0.5526; T_Stone5 0.7911 0.6494 0.5899; T_Stone7 0.5868 0.4643 0.434; "
     "T_Stone9 0.688 0.6539 0.6617"},
    {"stones1.inc", "texture { pigment { granite color_map { [0 rgbft <@>] } } }",
     "T_Grnt0a 0.7712 0.6515 0.579 0 0.6452; T_Grnt10 0.8562 0.7017 0.6736 0 0.001194; "
     "T_Grnt10a 0.8721 0.7336 0.6624 0 0.5283; T_Grnt11 0.7995 0.676 0.61 0 0.000614; "
     "T_Grnt11a 0.7369 0.7342 0.7434 0 0.6466; T_Grnt12a 0.8562 0.7017 0.6736 0 0.7003; "
     "T_Grnt13a 0.7995 0.676 0.61 0 0.5652; T_Grnt14a 0.9314 0.7529 0.6607 0 0.5371; "
     "T_Grnt15a 0.9785 0.7233 0.6666 0 0.4778; T_Grnt16a 0.7897 0.7444 0.7147 0 0.9372; "
     "T_Grnt17a 0.7479 0.6931 0.6565 0 0.6; T_Grnt18a 0.7677 0.7232 0.6917 0 0.247; "
     "T_Grnt19a 0.43 0.43 0.43 0 0.65; T_Grnt1a 0.9337 0.9253 0.8234 0 0.6767; "
     "T_Grnt20a 1 1 1 0.75 0.105; T_Grnt21 0.212 0.3679 0.2599 0 0.635; "
     "T_Grnt21a 1 1 1 0.75 0.16; T_Grnt22a 0.9356 0.7192 0.6021 0 0.7979; "
     "T_Grnt23a 0.4429 0.4833 0.4082 0 0.6107; T_Grnt24a 0.7983 0.6026 0.5304 0 0.5; "
     "T_Grnt2a 0.9257 0.8154 0.6716 0 0.5958; T_Grnt3a 0.8803 0.7411 0.6736 0 0.6532; "
     "T_Grnt4a 0.833 0.6647 0.5356 0 0.6487; T_Grnt5a 0.8117 0.6341 0.5381 0 0.6684; "
     "T_Grnt6a 0.6291 0.4893 0.3984 0 0.6444; T_Grnt7a 0.5021 0.3761 0.2884 0 0.7505; "
     "T_Grnt8a 0.3909 0.4393 0.4704 0 0.7505; T_Grnt9a 0.793 0.7728 0.7474 0 0.7141"},
    {"stones1.inc", "texture { pigment { marble color_map { [0 rgb <@>] } } }",
     "T_Grnt23 0.8798 0.7385 0.67; T_Grnt24 0.7369 0.7342 0.7434; T_Grnt25 0.4429 0.4833 0.4082; "
     "T_Grnt28 0.6926 0.2816 0.3275; T_Grnt29 0.7983 0.6026 0.5304; "
     "T_Stone21 0.5795 0.4172 0.4354; T_Stone23 0.7663 0.5877 0.4324; "
     "T_Stone24 0.5049 0.5372 0.4771"},
    {"stones1.inc", "texture { pigment { marble color_map { [0 rgb <@>] } } finish { ambient 0.2 } }",
     "T_Stone12 0.8413 0.7077 0.6377; T_Stone13 0.6506 0.6607 0.6753"},
    {"stones1.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { ambient 0.2 diffuse 0.9 } }",
     "T_Stone14 0.5666 0.4744 0.4141; T_Stone15 0.7355 0.7475 0.7553; "
     "T_Stone16 0.5127 0.5127 0.5127; T_Stone17 0.7489 0.7663 0.7489"},
    {"stones1.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { ambient 0.3 } }",
     "T_Stone18 0.4303 0.5719 0.5255"},
    {"stones1.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { diffuse 0.5 } }",
     "T_Stone4 0.7496 0.6093 0.5267"},
    {"stones1.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { phong 1 phong_size 90 } }",
     "T_Stone6 0.4269 0.395 0.395"},
    {"stones1.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { ambient 0.4 diffuse 0.7 } }",
     "T_Stone8 0.8828 0.8468 0.8211"},
    {"stones1.inc", "rgb <@>",
     "g1 0.26 0.41 0.31; g2 0.27 0.34 0.26; g3 0.13 0.29 0.28; g4 0.03 0.18 0.08"},
    {"stones2.inc", "texture { pigment { crackle color_map { [0 rgb <@>] } } }",
     "T_Stone25 0.4939 0.5134 0.4131; T_Stone27 0.3633 0.4575 0.4641; "
     "T_Stone31 0.2296 0.2278 0.2304; T_Stone32 0.6799 0.5847 0.5977; T_Stone33 0.7933 0.5616 0.34"},
    {"stones2.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } }",
     "T_Stone26 0.3601 0.4517 0.4999; T_Stone44 0.5188 0.4562 0.3875"},
    {"stones2.inc", "texture { pigment { agate color_map { [0 rgb <@>] } } }",
     "T_Stone28 0.4839 0.3966 0.3509"},
    {"stones2.inc", "texture { pigment { bozo color_map { [0 rgb <@>] } } }",
     "T_Stone29 0.4785 0.3619 0.2961; T_Stone30 0.6175 0.5701 0.4416; "
     "T_Stone34 0.7209 0.6872 0.6742; T_Stone35 0.7209 0.6872 0.6742"},
    {"stones2.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { brilliance 1.825 } }",
     "T_Stone36 0.3341 0.3261 0.1655"},
    {"stones2.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { brilliance 2.5 } }",
     "T_Stone37 0.3509 0.2553 0.05715"},
    {"stones2.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { brilliance 2.125 } }",
     "T_Stone38 0.4422 0.408 0.2584"},
    {"stones2.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { ambient 0.3 diffuse 0.575 brilliance 1.927 } }",
     "T_Stone39 0.632 0.4184 0.3692"},
    {"stones2.inc", "texture { pigment { agate color_map { [0 rgb <@>] } } finish { ambient 0.175 diffuse 0.6975 } }",
     "T_Stone40 0.444 0.6125 0.536"},
    {"stones2.inc", "texture { pigment { marble color_map { [0 rgb <@>] } } finish { brilliance 1.825 } }",
     "T_Stone41 0.1784 0.2749 0.4923"},
    {"stones2.inc", "texture { pigment { onion color_map { [0 rgb <@>] } } finish { brilliance 1.825 } }",
     "T_Stone42 0.3223 0.2029 0.03759"},
    {"stones2.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { brilliance 2.585 } }",
     "T_Stone43 0.6147 0.4184 0.2769"},
    {"skies.inc", "pigment { bozo color_map { [0 rgbf <@>] } }",
     "P_Cloud1 0.93 0.93 0.93 0.7"},
    {"skies.inc", "pigment { wrinkles color_map { [0 rgb <@>] } }",
     "P_Cloud2 0.4106 0.4106 0.5345; P_Cloud4 0.6333 0.7535 0.813"},
    {"skies.inc", "pigment { bozo color_map { [0 rgb <@>] } }",
     "P_Cloud3 0.2878 0.3003 0.3941"},
    {"skies.inc", "sky_sphere { pigment { bozo color_map { [0 rgb <@>] } } }",
     "S_Cloud1 0.3967 0.3912 0.4944; S_Cloud2 0.6003 0.7379 0.8134; "
     "S_Cloud3 0.3839 0.3839 0.5171; S_Cloud4 0.28 0.2916 0.3877; S_Cloud5 0.92 0.92 0.92"},
    {"skies.inc", "texture { pigment { bozo color_map { [0 rgbf <@>] } } finish { ambient 1 diffuse 0 } }",
     "T_Cloud1 0.8844 0.8844 0.8844 0.49"},
    {"skies.inc", "texture { pigment { bozo color_map { [0 rgbft <@>] } } finish { ambient 0.9 diffuse 0.1 } }",
     "T_Cloud2 0.9025 0.9025 0.9025 0 0.715"},
    {"skies.inc", "texture { pigment { bozo color_map { [0 rgbft <@>] } } finish { ambient 1 diffuse 0 } }",
     "T_Cloud3 0.9162 0.9162 0.9162 0 0.589"},
    {"stars.inc", "texture { pigment { granite color_map { [0 rgb <@>] } } finish { ambient 1 diffuse 0 } }",
     "Starfield1 0.0245 0.022 0.022; Starfield2 0.03675 0.033 0.033; "
     "Starfield3 0.049 0.044 0.044; Starfield4 0.0735 0.066 0.066; Starfield5 0.098 0.088 0.088; "
     "Starfield6 0.1225 0.11 0.11"},
    {"ior.inc", "@",
     "iorAdulariaMoonstone 1.52; iorAgate 1.544; iorAlexandrite 1.746; iorAmazonite 1.53; "
     "iorAmber 1.54; iorAmethyst 1.544; iorAmetrine 1.544; iorAndesine 1.53; iorAquamarine 1.58; "
     "iorAventurine 1.544; iorCZ 2.16; iorChalcedony 1.544; iorCitrine 1.544; iorCoral 1.486; "
     "iorCrownGlass 1.51673; iorCyanite 1.73; iorDisthene 1.73; iorEmerald 1.58; "
     "iorFireOpal 1.45; iorFlintGlass 1.78446; iorGarnetAlmandine 1.79; iorGarnetAndradite 1.888; "
     "iorGarnetDemantoid 1.885; iorGarnetGrossularite 1.74; iorGarnetPyrope 1.74; "
     "iorGarnetRhodolite 1.76; iorGarnetSpessartite 1.81; iorGarnetTsavorite 1.74; "
     "iorGlass 1.51673; iorHiddenite 1.67; iorIvory 1.54; iorJadeNephrite 1.62; iorJadeite 1.67; "
     "iorJasper 1.54; iorKunzite 1.67; iorLabradorite 1.56; iorLapisLazuli 1.5; "
     "iorMalachite 1.655; iorMoissanite 2.67; iorMoonstoneAdularia 1.52; iorMorganite 1.58; "
     "iorMossOpal 1.45; iorMunkrudite 1.73; iorNephriteJade 1.62; iorOnyx 1.544; iorOpal 1.45; "
     "iorOrthoclase 1.52; iorPadparadscha 1.766; iorPearl 1.53; iorPrehnite 1.64; "
     "iorRoseQuartz 1.544; iorRuby 1.766; iorSapphire 1.766; iorSmokyQuartz 1.544; "
     "iorTanzanite 1.7; iorTigersEye 1.544; iorTurquoise 1.61; iorWindowGlass 1.51673; "
     "iorZirconia 2.16"},
    {"rad_def.inc", "@",
     "Radiosity_2Bounce 4; Radiosity_Debug 1; Radiosity_Default 0; Radiosity_Fast 2; "
     "Radiosity_Final 5; Radiosity_IndoorHQ 10; Radiosity_IndoorLQ 9; Radiosity_Normal 3; "
     "Radiosity_OutdoorHQ 7; Radiosity_OutdoorLQ 6; Radiosity_OutdoorLight 8"},
    {"ash.map", "color_map { [0 rgb <@>] }",
     "M_Ash 0.5223 0.3477 0.2335"},
    {"benediti.map", "color_map { [0 rgb <@>] }",
     "M_Benediti 0.4657 0.4324 0.3727"},
    {"bubinga.map", "color_map { [0 rgb <@>] }",
     "M_Bubinga 0.3059 0.1311 0.09562"},
    {"cedar.map", "color_map { [0 rgb <@>] }",
     "M_Cedar 0.703 0.5561 0.4355"},
    {"marbteal.map", "color_map { [0 rgb <@>] }",
     "M_MarbTeal 0.2649 0.5591 0.4849"},
    {"orngwood.map", "color_map { [0 rgb <@>] }",
     "M_Orangewood 0.8162 0.4201 0.05463"},
    {"pinkmarb.map", "color_map { [0 rgb <@>] }",
     "M_PinkMarb 0.6594 0.5673 0.5148"},
    {"rdgranit.map", "color_map { [0 rgb <@>] }",
     "M_RedGranite 0.6871 0.586 0.5959"},
    {"teak.map", "color_map { [0 rgb <@>] }",
     "M_Teak 0.3079 0.1672 0.09827"},
    {"whiteash.map", "color_map { [0 rgb <@>] }",
     "M_WhiteAsh 0.6932 0.4559 0.303"},
};

// clang-format on

} // namespace raylane::scenes::pov
