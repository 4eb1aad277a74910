# What makes it hard to use a mistake in memory, if there should be one: raylane reads strangers' files.
# It is 0.5 % of a picture's instructions. The kernels are left out, by the property RAYLANE_PLAIN of their
# target: they read no file and have arrays of fixed lengths alone, and would be as much again. Sanitizers
# find more, by means of their own.
include(CheckPIESupported)
check_pie_supported(LANGUAGES CXX) # else the linker is not told of CMAKE_POSITION_INDEPENDENT_CODE
set(unless_plain $<NOT:$<BOOL:$<TARGET_PROPERTY:RAYLANE_PLAIN>>>)
# The standard library's own, where one looks for mistakes.
set(is_examined $<CONFIG:Debug>)
if(RAYLANE_SANITIZE) # a name or several with commas, which $<BOOL:> does not take
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
  check_cxx_compiler_flag(${flag} ${has}) # the last is for x86-64 alone
  if(${has})
    list(APPEND hardening ${flag})
  endif()
endforeach()
# The last needs an optimiser, as not all of the other configurations have.
list(APPEND hardening $<$<CONFIG:Release,MinSizeRel>:-U_FORTIFY_SOURCE>
     $<$<CONFIG:Release,MinSizeRel>:-D_FORTIFY_SOURCE=2>)
target_compile_options(raylane_flags INTERFACE "$<${unless_plain}:${hardening}>")
target_link_options(raylane_flags INTERFACE LINKER:-z,relro LINKER:-z,now LINKER:-z,noexecstack)
