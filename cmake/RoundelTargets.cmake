# Defines Roundel::roundel and Roundel::roundel_static inside this build, for add_subdirectory.

# System libraries that Rust's standard library needs when it is linked statically.
if(MSVC)
    set(ROUNDEL_STATIC_LIBS kernel32 ntdll userenv ws2_32 dbghelp msvcrt)
elseif(WIN32)
    set(ROUNDEL_STATIC_LIBS kernel32 ntdll userenv ws2_32 dbghelp)
elseif(APPLE)
    set(ROUNDEL_STATIC_LIBS System iconv m)
else()
    set(ROUNDEL_STATIC_LIBS gcc_s util rt pthread m dl c)
endif()

add_library(Roundel::roundel SHARED IMPORTED GLOBAL)
set_target_properties(
    Roundel::roundel
    PROPERTIES IMPORTED_LOCATION "${ROUNDEL_SHARED}"
               IMPORTED_SONAME "${ROUNDEL_SONAME}"
               INTERFACE_INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/include")

if(ROUNDEL_IMPORT)
    set_target_properties(Roundel::roundel PROPERTIES IMPORTED_IMPLIB "${ROUNDEL_IMPORT}")
endif()

add_library(Roundel::roundel_static STATIC IMPORTED GLOBAL)
set_target_properties(
    Roundel::roundel_static
    PROPERTIES IMPORTED_LOCATION "${ROUNDEL_STATIC}"
               INTERFACE_LINK_LIBRARIES "${ROUNDEL_STATIC_LIBS}"
               INTERFACE_INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/include")

foreach(target IN ITEMS Roundel::roundel Roundel::roundel_static)
    add_dependencies(${target} roundel_cargo)
    # The C++ layer needs C++17, which a project of C alone cannot be asked for.
    if("CXX" IN_LIST languages_before)
        set_target_properties(${target} PROPERTIES INTERFACE_COMPILE_FEATURES cxx_std_17)
    endif()
endforeach()
