# SPDX-License-Identifier: Apache-2.0
# What installs or runs the whole product.
if(NOT BRDF_INSTALL)
  return()
endif()

add_test(NAME integration.consumer COMMAND bash "${CMAKE_CURRENT_SOURCE_DIR}/consumer/check_installed_tree.sh"
  "${PROJECT_BINARY_DIR}" "${CMAKE_CXX_COMPILER}")
if(TARGET brdf-compress AND TARGET brdf-gonio)
  add_test(NAME integration.quickstart COMMAND bash "${PROJECT_SOURCE_DIR}/tools/quickstart")
endif()
add_test(NAME integration.optimisation_levels COMMAND "${Python3_EXECUTABLE}"
  "${CMAKE_CURRENT_SOURCE_DIR}/extremes/builds/compare_builds.py" "${PROJECT_SOURCE_DIR}" "${CMAKE_CXX_COMPILER}")
# Last: with ccache it takes what the quick start has compiled.
add_test(NAME integration.minimal_build COMMAND bash "${CMAKE_CURRENT_SOURCE_DIR}/consumer/check_minimal_build.sh"
  "${PROJECT_SOURCE_DIR}" "${CMAKE_CXX_COMPILER}")

set_tests_properties(integration.optimisation_levels PROPERTIES LABELS builds TIMEOUT 2400)
foreach(name IN ITEMS consumer quickstart minimal_build)
  if(TEST integration.${name})
    set_tests_properties(integration.${name} PROPERTIES LABELS integration TIMEOUT 1200)
  endif()
endforeach()
