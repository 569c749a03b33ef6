# Installs to FIRST and moves the tree to PREFIX. No file in it may name the first place.

file(REMOVE_RECURSE "${FIRST}" "${PREFIX}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${FIRST}"
                RESULT_VARIABLE failed)
if(failed)
    message(FATAL_ERROR "the installation failed")
endif()
file(RENAME "${FIRST}" "${PREFIX}")

file(GLOB_RECURSE texts "${PREFIX}/*.cmake" "${PREFIX}/*.pc" "${PREFIX}/*.h" "${PREFIX}/*.hpp"
     "${PREFIX}/*.hh")
if(NOT texts)
    message(FATAL_ERROR "nothing was installed")
endif()
foreach(file IN LISTS texts)
    file(READ "${file}" text)
    foreach(place IN ITEMS "${FIRST}" "${BUILD}")
        string(FIND "${text}" "${place}" at)
        if(NOT at EQUAL -1)
            message(FATAL_ERROR "${file} names ${place}")
        endif()
    endforeach()
endforeach()

file(READ "${PREFIX}/share/doc/Roundel/THIRD-PARTY-LICENCES.txt" licences)
foreach(part IN ITEMS "faer [0-9]" "Rust's standard library" "Apache License" "Permission is hereby granted")
    if(NOT licences MATCHES "${part}")
        message(FATAL_ERROR "the installed licences lack ${part}")
    endif()
endforeach()
