# Settings for builds by emscripten; see the preset wasm.

# Header-only libraries work with any compiler, so this machine's headers are used. They are linked into a
# separate folder, because other headers in theirs are not for WebAssembly. Packages' configurations describe
# this machine, so find_package() gets empty ones instead.
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

# WebAssembly's exceptions: a throw costs as much as one of the engine, and a call that does not throw costs
# nothing.
target_compile_options(raylane_flags INTERFACE
  -fwasm-exceptions -include ${PROJECT_SOURCE_DIR}/scenes/web/standard_library.hpp)
# -O1: with more, binaryen would take minutes to optimise LLVM's output again, to no effect. --wrap: see
# fma.cpp.
target_link_options(raylane_flags INTERFACE -fwasm-exceptions -O1 LINKER:--wrap=fma LINKER:--wrap=fmaf)
