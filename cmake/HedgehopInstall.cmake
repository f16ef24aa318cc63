# cmake --install: the program, its scenarios, and the package for building modules and loops outside this tree.
include_guard()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

hedgehop_offer(sim/libm sim/fields vision avoidance
               scenes dynamics sim/config sim/mavlink sim/scenario sim/render sim/collision sim/plugin sim/flight sim/verdict sim/loop sim/simulation
               sim/record)  # for the Python package of another interpreter
add_library(hedgehop_sim INTERFACE)
target_link_libraries(hedgehop_sim INTERFACE hedgehop_sim_simulation)
set_target_properties(hedgehop_sim PROPERTIES EXPORT_NAME sim)
install(TARGETS hedgehop_sim EXPORT hedgehop COMPONENT development)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/hedgehop)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/hedgehopConfig.cmake.in ${PROJECT_BINARY_DIR}/hedgehopConfig.cmake
                              INSTALL_DESTINATION ${package})
# A module is checked against the interface that it was built with (avoidance/plugin.h). The version number alone guarantees
# no compatibility.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hedgehopConfigVersion.cmake COMPATIBILITY ExactVersion)
install(FILES ${PROJECT_BINARY_DIR}/hedgehopConfig.cmake ${PROJECT_BINARY_DIR}/hedgehopConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/HedgehopOpenCV.cmake ${CMAKE_CURRENT_LIST_DIR}/HedgehopSleef.cmake
              ${CMAKE_CURRENT_LIST_DIR}/HedgehopPackages.cmake
        DESTINATION ${package} COMPONENT development)
install(EXPORT hedgehop NAMESPACE hedgehop:: FILE hedgehopTargets.cmake DESTINATION ${package} COMPONENT development)
set(loaded ${CMAKE_INSTALL_LIBDIR}/hedgehop)
file(RELATIVE_PATH from_program /${CMAKE_INSTALL_BINDIR} /${loaded})
set_target_properties(hedgehop PROPERTIES INSTALL_RPATH $ORIGIN/${from_program})
install(TARGETS hedgehop COMPONENT program)
if(TARGET hedgehop_native)
  file(RELATIVE_PATH from_package /lib/python3/dist-packages/hedgehop /${loaded})
  set_target_properties(hedgehop_native PROPERTIES INSTALL_RPATH $ORIGIN/${from_package})
endif()
get_property(loaded_libraries GLOBAL PROPERTY HEDGEHOP_LOADED)
if(loaded_libraries)
  install(TARGETS ${loaded_libraries} LIBRARY DESTINATION ${loaded} COMPONENT program)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs DESTINATION ${CMAKE_INSTALL_DATADIR}/hedgehop COMPONENT program)
