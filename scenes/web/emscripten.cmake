# What a build by emscripten needs: see the preset wasm.

# Headers alone, which are any compiler's: taken from where this machine has them, by links in a folder
# of their own, as what else is beside them is not WebAssembly's. Packages that say where they are say
# so of the machine, and are not asked.
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(package glm nlohmann xsimd stb)
  find_path(${package}_FOLDER ${package} PATHS /usr/local/include /usr/include NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  file(CREATE_LINK ${${package}_FOLDER}/${package} ${headers}/${package} SYMBOLIC)
endforeach()
foreach(package glm nlohmann_json xsimd)
  set(target ${package}::${package})
  if(package STREQUAL xsimd)
    set(target xsimd)
  endif()
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${headers})
  file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}-config.cmake "")
  file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}-config-version.cmake
       "set(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
endforeach()
find_path(xxhash_FOLDER xxhash.h PATHS /usr/local/include /usr/include NO_CMAKE_FIND_ROOT_PATH REQUIRED)
file(CREATE_LINK ${xxhash_FOLDER}/xxhash.h ${headers}/xxhash.h SYMBOLIC)
set(XXHASH_INCLUDE_DIR ${headers})
set(STB_INCLUDE_DIR ${headers}/stb)

# An exception costs what the engine's own do, and a call that throws none, nothing.
target_compile_options(raylane_flags INTERFACE
  -fwasm-exceptions -include ${PROJECT_SOURCE_DIR}/scenes/web/standard_library.hpp)
# What LLVM has optimised, binaryen would take minutes to look at again, for nothing (-O1). fma.cpp.
target_link_options(raylane_flags INTERFACE -fwasm-exceptions -O1 LINKER:--wrap=fma LINKER:--wrap=fmaf)
