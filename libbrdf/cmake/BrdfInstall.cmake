# SPDX-License-Identifier: Apache-2.0
# Install rules: headers, libraries, CMake package and pkg-config files. Each library has an export set of its own, so
# that a consumer of brdf::decode never looks for Ceres.
include(CMakePackageConfigHelpers)

set(brdf_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/brdf")
# From the .pc files to the prefix, so that an installed tree may be moved.
file(RELATIVE_PATH PC_PREFIX "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" PC_PREFIX "${PC_PREFIX}")

function(brdf_install_library target component)
  install(TARGETS ${target} EXPORT brdf-${component}
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(EXPORT brdf-${component} NAMESPACE brdf:: FILE brdf-${component}-targets.cmake
    DESTINATION "${brdf_package_dir}")
endfunction()

# @param requires pkg-config packages; @param private_libs linker flags of what has no pkg-config file
function(brdf_install_pkgconfig name library description public_requires private_requires private_libs)
  # A static archive needs what it is made of at every link; only a shared library may hide it.
  if(BUILD_SHARED_LIBS)
    set(PC_REQUIRES "${public_requires}")
    set(PC_REQUIRES_PRIVATE "${private_requires}")
    set(PC_LIBS "")
    set(PC_LIBS_PRIVATE "${private_libs}")
  else()
    set(PC_REQUIRES "${public_requires} ${private_requires}")
    set(PC_REQUIRES_PRIVATE "")
    set(PC_LIBS " ${private_libs}")
    set(PC_LIBS_PRIVATE "")
  endif()
  set(PC_NAME "${name}")
  set(PC_LIBRARY "${library}")
  set(PC_DESCRIPTION "${description}")
  configure_file("${PROJECT_SOURCE_DIR}/libbrdf/cmake/brdf.pc.in" "${CMAKE_CURRENT_BINARY_DIR}/${name}.pc" @ONLY)
  install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endfunction()

install(DIRECTORY include/brdf DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")

brdf_install_library(brdf_decode decode)
brdf_install_pkgconfig(brdf-decode brdf_decode "Reads, evaluates and samples compressed measured BRDFs"
  "glm" "libhwy" "")
if(brdf_have_encoder)
  brdf_install_library(brdf brdf)
  brdf_install_pkgconfig(brdf brdf "Compresses measured BRDFs" "brdf-decode = ${PROJECT_VERSION}" ""
    "-lceres -lglog -lpthread")
endif()

configure_package_config_file("${PROJECT_SOURCE_DIR}/libbrdf/cmake/brdf-config.cmake.in"
  "${CMAKE_CURRENT_BINARY_DIR}/brdf-config.cmake" INSTALL_DESTINATION "${brdf_package_dir}"
  NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change interfaces.
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/brdf-config-version.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/brdf-config.cmake" "${CMAKE_CURRENT_BINARY_DIR}/brdf-config-version.cmake"
  DESTINATION "${brdf_package_dir}")
