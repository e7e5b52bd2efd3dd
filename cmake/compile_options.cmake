# One interface target carries the flags of all our targets; nothing here is exported to users.
add_library(cairn_compile_options INTERFACE)
target_compile_options(cairn_compile_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  -ffp-contract=off)  # same bits on every machine: a*b+c is never fused
# Only for the compilers that we develop with: each version has its own false alarms, which must not stop a user's build.
if(CAIRN_WERROR AND "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" MATCHES "^(GNU 12|Clang 16)\\.")
  target_compile_options(cairn_compile_options INTERFACE -Werror)
endif()
if(CAIRN_NATIVE)
  target_compile_options(cairn_compile_options INTERFACE -march=native)
endif()
if(CAIRN_SANITIZE)
  target_compile_options(cairn_compile_options INTERFACE
    -fsanitize=${CAIRN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(cairn_compile_options INTERFACE -fsanitize=${CAIRN_SANITIZE})
endif()

find_program(CAIRN_CCACHE ccache)
if(CAIRN_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CAIRN_CCACHE})
endif()
find_program(CAIRN_MOLD mold)
if(CAIRN_MOLD)
  target_link_options(cairn_compile_options INTERFACE -fuse-ld=mold)
endif()
