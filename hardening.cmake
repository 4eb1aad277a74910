# Makes errors in memory hard to exploit, because raylane reads untrusted input. This costs 0.5 % of a
# picture's instructions. The kernels are left out, by the property RAYLANE_PLAIN of their target: they read
# no files and use only arrays of fixed length, and would cost as much again. Builds with sanitizers are left
# out, because these find more by their own means.
include(CheckPIESupported)
check_pie_supported(LANGUAGES CXX) # otherwise the linker ignores CMAKE_POSITION_INDEPENDENT_CODE
set(unless_plain $<NOT:$<BOOL:$<TARGET_PROPERTY:RAYLANE_PLAIN>>>)
# The standard library's assertions, for builds that search for errors.
set(is_examined $<CONFIG:Debug>)
if(RAYLANE_SANITIZE) # a list with commas is possible, which $<BOOL:> does not accept
  set(is_examined 1)
endif()
target_compile_definitions(raylane_flags INTERFACE $<$<AND:${unless_plain},${is_examined}>:_GLIBCXX_ASSERTIONS>)
if(NOT RAYLANE_HARDENED OR RAYLANE_SANITIZE)
  return()
endif()
include(CheckCXXCompilerFlag)
set(hardening)
foreach(flag -fstack-protector-strong -fstack-clash-protection -fcf-protection)
  string(MAKE_C_IDENTIFIER "has${flag}" has)
  check_cxx_compiler_flag(${flag} ${has}) # -fcf-protection exists on x86-64 only
  if(${has})
    list(APPEND hardening ${flag})
  endif()
endforeach()
# _FORTIFY_SOURCE needs optimisation, which some of the other configurations lack.
list(APPEND hardening $<$<CONFIG:Release,MinSizeRel>:-U_FORTIFY_SOURCE>
     $<$<CONFIG:Release,MinSizeRel>:-D_FORTIFY_SOURCE=2>)
target_compile_options(raylane_flags INTERFACE "$<${unless_plain}:${hardening}>")
target_link_options(raylane_flags INTERFACE LINKER:-z,relro LINKER:-z,now LINKER:-z,noexecstack)
