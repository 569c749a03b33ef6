# Builds the library with cargo. Only cargo knows what has changed, so the target always runs. It copies
# cargo's outputs only if they differ.

find_program(CARGO cargo HINTS "$ENV{HOME}/.cargo/bin" REQUIRED)

set(ROUNDEL_CARGO_TARGET_DIR "" CACHE PATH "Where cargo builds; empty for cargo's own choice")
if(ROUNDEL_CARGO_TARGET_DIR)
    set(cargo_dir "${ROUNDEL_CARGO_TARGET_DIR}")
elseif(DEFINED ENV{CARGO_TARGET_DIR})
    get_filename_component(cargo_dir "$ENV{CARGO_TARGET_DIR}" ABSOLUTE
                           BASE_DIR "${PROJECT_SOURCE_DIR}")
else()
    set(cargo_dir "${PROJECT_SOURCE_DIR}/target")
endif()

file(STRINGS src/capi/abi.rs abi_line REGEX "ROUNDEL_ABI_VERSION: i32 = [0-9]+")
string(REGEX MATCH "= ([0-9]+)" abi_match "${abi_line}")
set(ROUNDEL_ABI_VERSION "${CMAKE_MATCH_1}")
if(NOT ROUNDEL_ABI_VERSION)
    message(FATAL_ERROR "src/capi/abi.rs does not say the ABI number")
endif()

set(ROUNDEL_CARGO_TARGET "" CACHE STRING
    "The target that cargo builds for, such as x86_64-pc-windows-gnu; empty for cargo's own choice")
set(cargo_target "")
set(cargo_output "${cargo_dir}/release")
if(ROUNDEL_CARGO_TARGET)
    set(cargo_target --target "${ROUNDEL_CARGO_TARGET}")
    set(cargo_output "${cargo_dir}/${ROUNDEL_CARGO_TARGET}/release")
endif()

# cargo's names of the libraries, and ours: elsewhere than on Windows the name of the shared library has the version.
set(ROUNDEL_SONAME "")
set(ROUNDEL_SHARED_LINKS "")
set(ROUNDEL_IMPORT_NAME "")
set(ROUNDEL_STATIC_NAME libroundel.a)
set(program roundel)
if(WIN32)
    set(ROUNDEL_SHARED_NAME roundel.dll)
    set(cargo_shared roundel.dll)
    set(program roundel.exe)
    if(MSVC)
        set(ROUNDEL_IMPORT_NAME roundel.dll.lib)
        set(ROUNDEL_STATIC_NAME roundel.lib)
    else()
        set(ROUNDEL_IMPORT_NAME libroundel.dll.a)
    endif()
elseif(APPLE)
    set(ROUNDEL_SHARED_NAME libroundel.${PROJECT_VERSION}.dylib)
    set(ROUNDEL_SONAME @rpath/libroundel.${ROUNDEL_ABI_VERSION}.dylib)
    set(ROUNDEL_SHARED_LINKS libroundel.${ROUNDEL_ABI_VERSION}.dylib libroundel.dylib)
    set(cargo_shared libroundel.dylib)
else()
    set(ROUNDEL_SHARED_NAME libroundel.so.${PROJECT_VERSION})
    set(ROUNDEL_SONAME libroundel.so.${ROUNDEL_ABI_VERSION})
    set(ROUNDEL_SHARED_LINKS ${ROUNDEL_SONAME} libroundel.so)
    set(cargo_shared libroundel.so)
endif()
set(ROUNDEL_LIB_DIR "${PROJECT_BINARY_DIR}/lib")
set(ROUNDEL_SHARED "${ROUNDEL_LIB_DIR}/${ROUNDEL_SHARED_NAME}")
set(ROUNDEL_STATIC "${ROUNDEL_LIB_DIR}/${ROUNDEL_STATIC_NAME}")

# A DLL is linked through a library of its own.
set(import_command "")
set(ROUNDEL_IMPORT "")
if(ROUNDEL_IMPORT_NAME)
    set(ROUNDEL_IMPORT "${ROUNDEL_LIB_DIR}/${ROUNDEL_IMPORT_NAME}")
    set(import_command COMMAND "${CMAKE_COMMAND}" -E copy_if_different
        "${cargo_output}/${ROUNDEL_IMPORT_NAME}" "${ROUNDEL_IMPORT}")
endif()

set(link_commands "")
set(ROUNDEL_SHARED_LINK_FILES "")
foreach(link IN LISTS ROUNDEL_SHARED_LINKS)
    list(APPEND link_commands COMMAND "${CMAKE_COMMAND}" -E create_symlink
         ${ROUNDEL_SHARED_NAME} "${ROUNDEL_LIB_DIR}/${link}")
    list(APPEND ROUNDEL_SHARED_LINK_FILES "${ROUNDEL_LIB_DIR}/${link}")
endforeach()

# Both packages are always named, because cargo compiles the dependencies with the features of those that are:
# other calls would compile the library again.
set(cargo_packages --package roundel --package roundel-cli)
set(generate_command "")
set(ROUNDEL_PROGRAM "${cargo_output}/${program}")
# Manual pages and completions, which the program writes, where it runs and there are readers of them.
set(ROUNDEL_GENERATED "")
if(NOT ROUNDEL_BUILD_PROGRAM AND NOT ROUNDEL_BUILD_TESTS)
    list(APPEND cargo_packages --lib)
elseif(NOT WIN32 AND NOT CMAKE_CROSSCOMPILING)
    set(ROUNDEL_GENERATED "${PROJECT_BINARY_DIR}/generated")
    set(generate_command COMMAND "${ROUNDEL_PROGRAM}" generate "${ROUNDEL_GENERATED}")
endif()

# The licences of all that is linked in, which go with what is installed. Without Python they are left out.
set(ROUNDEL_LICENCES "${PROJECT_BINARY_DIR}/THIRD-PARTY-LICENCES.txt")
set(licences_command "")
if(is_top_level)
    find_package(Python3 COMPONENTS Interpreter QUIET)
endif()
if(is_top_level AND Python3_Interpreter_FOUND)
    set(licences_command COMMAND "${CMAKE_COMMAND}" "-DPYTHON=${Python3_EXECUTABLE}"
        "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DFILE=${ROUNDEL_LICENCES}"
        -P "${PROJECT_SOURCE_DIR}/cmake/WriteLicences.cmake")
endif()

add_custom_target(
    roundel_cargo ALL
    COMMAND "${CMAKE_COMMAND}" -E env "CARGO_TARGET_DIR=${cargo_dir}"
            "${CARGO}" build --locked --release ${cargo_target} ${cargo_packages}
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${ROUNDEL_LIB_DIR}"
    COMMAND "${CMAKE_COMMAND}" -E copy_if_different
            "${cargo_output}/${cargo_shared}" "${ROUNDEL_SHARED}"
    COMMAND "${CMAKE_COMMAND}" -E copy_if_different
            "${cargo_output}/${ROUNDEL_STATIC_NAME}" "${ROUNDEL_STATIC}"
    ${import_command}
    ${link_commands}
    ${generate_command}
    ${licences_command}
    BYPRODUCTS "${ROUNDEL_SHARED}" "${ROUNDEL_STATIC}" ${ROUNDEL_IMPORT}
    WORKING_DIRECTORY "${PROJECT_SOURCE_DIR}"
    COMMENT "Building roundel with cargo, which takes some minutes the first time"
    USES_TERMINAL VERBATIM)
