# Defines the target CoMISo::CoMISo: CoMISo's interface over this library, for programs written for
# CoMISo. An existing target of that name is kept.
#
# With ROUNDEL_COMISO_REAL_GMM, the gmm.h that stands in for GMM++ is left out, so that the real one is
# found.

option(ROUNDEL_COMISO_REAL_GMM "CoMISo::CoMISo uses an installed GMM++" OFF)

if(NOT TARGET CoMISo::CoMISo)
    add_library(CoMISo::CoMISo INTERFACE IMPORTED GLOBAL)
    set(comiso_includes "${PROJECT_SOURCE_DIR}/compat/include")
    if(NOT ROUNDEL_COMISO_REAL_GMM)
        list(APPEND comiso_includes "${PROJECT_SOURCE_DIR}/compat/shim")
    endif()
    set_target_properties(CoMISo::CoMISo
                          PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${comiso_includes}"
                                     INTERFACE_COMPILE_FEATURES cxx_std_17
                                     INTERFACE_LINK_LIBRARIES Roundel::roundel)
endif()

# The version of CoMISo's interface, not of Roundel.
set(COMISO_INTERFACE_VERSION 1.1.0)

set(comiso_include "${CMAKE_INSTALL_INCLUDEDIR}/roundel-comiso")
install(DIRECTORY compat/include/CoMISo DESTINATION "${comiso_include}/include"
        FILES_MATCHING PATTERN "*.hh")
install(DIRECTORY compat/shim/gmm DESTINATION "${comiso_include}/shim"
        FILES_MATCHING PATTERN "*.h")

set(comiso_config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/CoMISo")
configure_package_config_file(
    compat/cmake/CoMISoConfig.cmake.in "${PROJECT_BINARY_DIR}/CoMISoConfig.cmake"
    INSTALL_DESTINATION "${comiso_config_dir}"
    PATH_VARS comiso_include
    NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/CoMISoConfigVersion.cmake"
                                 VERSION ${COMISO_INTERFACE_VERSION}
                                 COMPATIBILITY SameMajorVersion)
install(FILES "${PROJECT_BINARY_DIR}/CoMISoConfig.cmake"
              "${PROJECT_BINARY_DIR}/CoMISoConfigVersion.cmake"
        DESTINATION "${comiso_config_dir}")
# find_package ignores the case of the name when it looks for config files of this other spelling.
install(FILES "${PROJECT_BINARY_DIR}/CoMISoConfig.cmake" DESTINATION "${comiso_config_dir}"
        RENAME comiso-config.cmake)
install(FILES "${PROJECT_BINARY_DIR}/CoMISoConfigVersion.cmake"
        DESTINATION "${comiso_config_dir}" RENAME comiso-config-version.cmake)
install(FILES compat/cmake/FindCoMISo.cmake DESTINATION "${comiso_config_dir}/modules")
install(FILES compat/cmake/FindCoMISo.cmake DESTINATION "${comiso_config_dir}/modules"
        RENAME FindCOMISO.cmake)
