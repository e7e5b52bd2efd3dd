# cairn_kernels(<room> <source>...)
#
# Compiles each source once per instruction set, with CAIRN_ISA naming the set's namespace, and adds the objects to the
# room. Such sources include no header that defines inline functions with external linkage (no standard containers or
# algorithms): the linker keeps one copy of those, and it might be the one that an older processor cannot run.
# tests/check_kernels.py holds this.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(CAIRN_X86_KERNELS ON)
endif()

function(cairn_kernels room)
  set(flags_plain "")
  set(flags_sse42 -msse4.2 -mpopcnt)
  set(flags_avx2 ${flags_sse42} -mavx2 -mbmi -mbmi2)
  set(flags_avx512 ${flags_avx2} -mavx512f -mavx512bw -mavx512vl -mavx512dq -mavx512vbmi -mavx512vnni
      -mavx512bitalg -mavx512vpopcntdq -mprefer-vector-width=512)
  set(sets plain)
  if(CAIRN_X86_KERNELS)
    list(APPEND sets sse42 avx2 avx512)
  endif()
  foreach(set ${sets})
    set(objects cairn_${room}_${set})
    add_library(${objects} OBJECT ${ARGN})
    target_compile_options(${objects} PRIVATE ${flags_${set}})
    target_compile_definitions(${objects} PRIVATE CAIRN_ISA=${set})
    target_link_libraries(${objects} PRIVATE cairn::simd cairn_compile_options)
    target_sources(cairn_${room} PRIVATE $<TARGET_OBJECTS:${objects}>)
  endforeach()
endfunction()
