# `cmake --install`: the program, the libraries, the public headers and a package for find_package(airlight CONFIG).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
install(TARGETS airlight airlight_core airlight_scene airlight_transfer airlight_reference airlight_cpu airlight_gpu EXPORT airlight
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT airlight)
install(TARGETS airlight_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT airlight)
install(FILES app/airlight.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/airlight/app COMPONENT airlight)
install(DIRECTORY common/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/airlight/common COMPONENT airlight
  FILES_MATCHING PATTERN "*.h" PATTERN formulas EXCLUDE PATTERN plan EXCLUDE PATTERN transfer EXCLUDE PATTERN reference EXCLUDE)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/airlight)
install(EXPORT airlight FILE airlightTargets.cmake NAMESPACE airlight:: DESTINATION ${package} COMPONENT airlight)
configure_package_config_file(cmake/airlightConfig.cmake.in airlightConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(airlightConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/airlightConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/airlightConfigVersion.cmake
  DESTINATION ${package} COMPONENT airlight)

# ./dev pack: what runs on a machine where nothing can be installed, with every library but the C library.
if(AIRLIGHT_TESTS AND AIRLIGHT_BENCH)
  set_target_properties(airlight-parity airlight-kernels PROPERTIES INSTALL_RPATH "$ORIGIN")
  target_link_options(airlight-parity PRIVATE -Wl,--disable-new-dtags)  # so that it also holds for what the libraries need
  target_link_options(airlight-kernels PRIVATE -Wl,--disable-new-dtags)
  install(TARGETS airlight-parity airlight-kernels RUNTIME_DEPENDENCY_SET packed RUNTIME DESTINATION . COMPONENT pack EXCLUDE_FROM_ALL)
  install(RUNTIME_DEPENDENCY_SET packed PRE_EXCLUDE_REGEXES "^ld-linux" "^libc\\.so" "^libm\\.so"
    LIBRARY DESTINATION . COMPONENT pack EXCLUDE_FROM_ALL)
endif()
