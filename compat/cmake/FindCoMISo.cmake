# A find module for projects that look for CoMISo: it gives them CoMISo's interface, solved by Roundel.
#
# Defines the target CoMISo::CoMISo, and for old projects the variables COMISO_FOUND,
# COMISO_INCLUDE_DIR, COMISO_INCLUDE_DIRS, COMISO_LIBRARY and COMISO_LIBRARIES.

find_package(CoMISo CONFIG QUIET HINTS "${CMAKE_CURRENT_LIST_DIR}/..")

if(TARGET CoMISo::CoMISo)
    get_target_property(COMISO_INCLUDE_DIRS CoMISo::CoMISo INTERFACE_INCLUDE_DIRECTORIES)
    set(COMISO_INCLUDE_DIR "${COMISO_INCLUDE_DIRS}")
    set(COMISO_LIBRARIES CoMISo::CoMISo)
    set(COMISO_LIBRARY "${COMISO_LIBRARIES}")
    set(COMISO_FOUND TRUE)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args("${CMAKE_FIND_PACKAGE_NAME}"
                                  REQUIRED_VARS COMISO_LIBRARIES COMISO_INCLUDE_DIRS)
