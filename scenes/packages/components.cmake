# The components that raylane may contain besides its own code. For each one: its name, the version found
# here, its licence, its origin, its shared libraries (a regular expression of their names, or empty), and the
# binaries of raylane that have its headers compiled in. write_sbom.cmake lists them.
set(components "")
function(component id version licence origin libraries) # binaries...
  list(JOIN ARGN "," binaries)
  list(APPEND components "${id}~${version}~${licence}~${origin}~${libraries}~${binaries}")
  set(components ${components} PARENT_SCOPE)
endfunction()
# Gets the value of a macro that a header defines as a version.
function(macro_of file name result)
  file(STRINGS ${file} line REGEX "define[ \t]+${name}[ \t]" LIMIT_COUNT 1)
  string(REGEX REPLACE ".*${name}[ \t]+\"?([0-9.]+).*" "\\1" value "${line}")
  set(${result} "${value}" PARENT_SCOPE)
endfunction()

find_package(TBB 2021 REQUIRED)
find_package(xsimd REQUIRED)
find_package(glm REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
component(oneTBB "${TBB_VERSION}" Apache-2.0 github/oneapi-src/oneTBB "libtbb[.]" raylane libraylane)
component(libpng "${PNG_VERSION_STRING}" libpng-2.0 github/pnggroup/libpng "libpng[0-9]*[.]" raylane libraylane)
component(zlib "${ZLIB_VERSION_STRING}" Zlib github/madler/zlib "libz[.]" raylane libraylane)
component(xsimd "${xsimd_VERSION}" BSD-3-Clause github/xtensor-stack/xsimd "" raylane libraylane)
component(GLM "${glm_VERSION}" MIT github/g-truc/glm "" raylane libraylane)
component(nlohmann-json "${nlohmann_json_VERSION}" MIT github/nlohmann/json "" raylane libraylane)
component(CLI11 "${CLI11_VERSION}" BSD-3-Clause github/CLIUtils/CLI11 "" raylane)

file(STRINGS ${STB_INCLUDE_DIR}/stb_image_write.h version REGEX "v[0-9.]+" LIMIT_COUNT 1)
string(REGEX MATCH "[0-9][0-9.]+" version "${version}")
component(stb-image-write "${version}" "MIT OR Unlicense" github/nothings/stb "" raylane libraylane)

set(version "")
foreach(part MAJOR MINOR RELEASE)
  macro_of(${XXHASH_INCLUDE_DIR}/xxhash.h XXH_VERSION_${part} number)
  list(APPEND version ${number})
endforeach()
list(JOIN version "." version)
component(xxHash "${version}" BSD-2-Clause github/Cyan4973/xxHash "libxxhash[.]" raylane libraylane)

if(RAYLANE_HAS_gemmi)
  component(gemmi "${GEMMI_VERSION}" "(MPL-2.0 OR LGPL-3.0-only) AND (Apache-2.0 OR MIT)" # its fast_float
            github/project-gemmi/gemmi "libgemmi" raylane libraylane)
  macro_of(${PEGTL_INCLUDE_DIR}/tao/pegtl/version.hpp TAO_PEGTL_VERSION version)
  component(PEGTL "${version}" MIT github/taocpp/PEGTL "" raylane libraylane)
endif()
if(RAYLANE_HAS_OpenEXR)
  component(OpenEXR "${OpenEXR_VERSION}" BSD-3-Clause github/AcademySoftwareFoundation/openexr
            "lib(OpenEXR|Iex|IlmThread)" raylane)
  component(Imath "${Imath_VERSION}" BSD-3-Clause github/AcademySoftwareFoundation/Imath "libImath" raylane)
endif()
if(RAYLANE_HAS_SDL2)
  component(SDL2 "${SDL2_VERSION}" Zlib github/libsdl-org/SDL "libSDL2" raylane-window)
endif()
if(RAYLANE_HAS_MPI)
  set(version "")
  if(EXISTS ${MPI_CXX_HEADER_DIR}/mpi.h)
    foreach(part MAJOR MINOR RELEASE)
      macro_of(${MPI_CXX_HEADER_DIR}/mpi.h OMPI_${part}_VERSION number)
      list(APPEND version ${number})
    endforeach()
    list(JOIN version "." version)
  endif()
  component(OpenMPI "${version}" BSD-3-Clause-Open-MPI github/open-mpi/ompi "libmpi" raylane-mpi)
endif()

# The libraries of the compiler and of the system.
execute_process(COMMAND ${CMAKE_CXX_COMPILER} -std=c++20 -E -dM -x c++ -include cstddef /dev/null
                OUTPUT_VARIABLE macros ERROR_QUIET)
foreach(name __GLIBC__ __GLIBC_MINOR__ _GLIBCXX_RELEASE)
  string(REGEX MATCH "define ${name} ([0-9]+)" ignored "${macros}")
  set(${name} "${CMAKE_MATCH_1}")
endforeach()
component(GCC-runtime "${_GLIBCXX_RELEASE}" "GPL-3.0-or-later WITH GCC-exception-3.1" generic/gcc
          "lib(stdc[+][+]|gcc_s|atomic|[alt]san|ubsan)[.]" raylane libraylane raylane-window raylane-mpi)
component(glibc "${__GLIBC__}.${__GLIBC_MINOR__}" LGPL-2.1-or-later generic/glibc
          "(lib(c|m|dl|pthread|rt)[.]|ld-linux)" raylane libraylane raylane-window raylane-mpi)
