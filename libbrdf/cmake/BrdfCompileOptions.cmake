# SPDX-License-Identifier: Apache-2.0
# Options that every target of this project shares, through brdf_compile_options(<target>).

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

if(NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(BRDF_CCACHE ccache)
  if(BRDF_CCACHE)
    # What another checkout compiled serves this one: paths count from the checkout, and precompiled headers by content.
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime "${BRDF_CCACHE}")
  endif()
endif()

# A flag of the whole build and not of single targets: code of one kind must not link with code of the other.
if(BRDF_SANITIZE)
  set(brdf_sanitize_flags -fsanitize=${BRDF_SANITIZE} -fno-omit-frame-pointer)
  if(BRDF_SANITIZE MATCHES "undefined")
    # A float that does not fit its integer is undefined, yet outside gcc's and clang's "undefined" group.
    list(APPEND brdf_sanitize_flags -fsanitize=float-cast-overflow -fno-sanitize-recover=all)
  endif()
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    # Spares Highway its emulation of vectors by loops, which takes minutes to compile once it is instrumented.
    list(APPEND brdf_sanitize_flags -msse4.2 -maes -mpclmul)
  endif()
  add_compile_options(${brdf_sanitize_flags})
  add_link_options(${brdf_sanitize_flags})
endif()
if(BRDF_BUILD_FUZZERS)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    message(FATAL_ERROR "BRDF_BUILD_FUZZERS needs clang, found ${CMAKE_CXX_COMPILER_ID}; use the preset 'fuzz'")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

function(brdf_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion $<$<BOOL:${BRDF_WERROR}>:-Werror>
    # The bytes written, and the value of the scalar reference, must not depend on whether the processor has a fused
    # multiply-add. Vector code asks for it by name, so this costs nothing there.
    -ffp-contract=off)
endfunction()

# Of a program that is installed: found in bin/ of the build, and its libraries wherever the installed tree is moved to.
function(brdf_program_options target)
  brdf_compile_options(${target})
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin"
    INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  if(BRDF_INSTALL)
    install(TARGETS ${target} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  endif()
endfunction()

# Headers that nearly every source of the target reads. A file still names all that it uses: the preset "minimal" and
# whoever sets CMAKE_DISABLE_PRECOMPILE_HEADERS build without this.
function(brdf_precompile target)
  target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <functional> <limits> <memory>
    <optional> <span> <string> <vector> ${ARGN})
endfunction()
