# An overlay port, for `vcpkg install roundel --overlay-ports=packaging/vcpkg`. It builds the repository that holds it;
# a port in the registry of vcpkg takes an archive of a release instead. cargo must be there.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

find_program(CARGO cargo HINTS "$ENV{HOME}/.cargo/bin" REQUIRED)

# cargo builds with optimisation alone.
set(VCPKG_BUILD_TYPE release)

vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        "-DCARGO=${CARGO}"
        "-DROUNDEL_CARGO_TARGET_DIR=${CURRENT_BUILDTREES_DIR}/cargo"
        -DROUNDEL_BUILD_PROGRAM=OFF)
vcpkg_cmake_install()

if(VCPKG_LIBRARY_LINKAGE STREQUAL "static")
    file(GLOB unused "${CURRENT_PACKAGES_DIR}/lib/libroundel.so*" "${CURRENT_PACKAGES_DIR}/lib/*.dylib")
else()
    file(GLOB unused "${CURRENT_PACKAGES_DIR}/lib/libroundel.a")
endif()
file(REMOVE ${unused})

vcpkg_cmake_config_fixup(PACKAGE_NAME roundel CONFIG_PATH lib/cmake/Roundel DO_NOT_DELETE_PARENT_CONFIG_PATH)
vcpkg_cmake_config_fixup(PACKAGE_NAME comiso CONFIG_PATH lib/cmake/CoMISo)
vcpkg_fixup_pkgconfig()

set(licences "${CURRENT_PACKAGES_DIR}/share/doc/Roundel")
vcpkg_install_copyright(FILE_LIST "${licences}/LICENSE-MIT" "${licences}/LICENSE-APACHE"
                        "${licences}/THIRD-PARTY-LICENCES.txt")
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/doc")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
