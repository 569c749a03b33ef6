# Installs libraries, headers, the CMake package and the pkg-config module. No installed file names the
# place of installation, so the tree can be moved.

include(CMakePackageConfigHelpers)

# Windows looks for a DLL beside the program.
set(ROUNDEL_SHARED_DIR "${CMAKE_INSTALL_LIBDIR}")
if(WIN32)
    set(ROUNDEL_SHARED_DIR "${CMAKE_INSTALL_BINDIR}")
endif()
install(PROGRAMS "${ROUNDEL_SHARED}" DESTINATION "${ROUNDEL_SHARED_DIR}")
install(FILES "${ROUNDEL_STATIC}" ${ROUNDEL_IMPORT} ${ROUNDEL_SHARED_LINK_FILES}
        DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY include/roundel DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}"
        FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")

if(ROUNDEL_BUILD_PROGRAM)
    install(PROGRAMS "${ROUNDEL_PROGRAM}" DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
if(ROUNDEL_BUILD_PROGRAM AND ROUNDEL_GENERATED)
    install(DIRECTORY "${ROUNDEL_GENERATED}/man1" DESTINATION "${CMAKE_INSTALL_MANDIR}")
    set(completions "${ROUNDEL_GENERATED}/completions")
    install(FILES "${completions}/bash/roundel.bash" RENAME roundel
            DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
    install(FILES "${completions}/zsh/_roundel"
            DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/site-functions")
    install(FILES "${completions}/fish/roundel.fish"
            DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
endif()

install(FILES LICENSE-MIT LICENSE-APACHE THIRD-PARTY.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(FILES "${ROUNDEL_LICENCES}" DESTINATION "${CMAKE_INSTALL_DOCDIR}" OPTIONAL)

set(config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/Roundel")
configure_package_config_file(
    cmake/RoundelConfig.cmake.in "${PROJECT_BINARY_DIR}/RoundelConfig.cmake"
    INSTALL_DESTINATION "${config_dir}"
    PATH_VARS CMAKE_INSTALL_INCLUDEDIR CMAKE_INSTALL_LIBDIR ROUNDEL_SHARED_DIR
    NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# While the major version is 0, a new minor version may be incompatible, a new patch may not.
if(PROJECT_VERSION_MAJOR EQUAL 0)
    set(compatibility SameMinorVersion)
else()
    set(compatibility SameMajorVersion)
endif()
write_basic_package_version_file("${PROJECT_BINARY_DIR}/RoundelConfigVersion.cmake"
                                 COMPATIBILITY ${compatibility})
install(FILES "${PROJECT_BINARY_DIR}/RoundelConfig.cmake"
              "${PROJECT_BINARY_DIR}/RoundelConfigVersion.cmake"
        DESTINATION "${config_dir}")

# The path from lib/pkgconfig back to the prefix, whatever the depth of lib.
file(RELATIVE_PATH pc_up "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" pc_up "${pc_up}")
set(pc_private "")
foreach(lib IN LISTS ROUNDEL_STATIC_LIBS)
    string(APPEND pc_private " -l${lib}")
endforeach()
configure_file(cmake/roundel.pc.in "${PROJECT_BINARY_DIR}/roundel.pc" @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/roundel.pc"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
