# Runs the consumers in the directory that the last argument names, and checks their output.

math(EXPR last "${CMAKE_ARGC} - 1")
file(GLOB programs RELATIVE "${CMAKE_ARGV${last}}" "${CMAKE_ARGV${last}}/c*_consumer")
if(NOT programs)
    message(FATAL_ERROR "nothing was built")
endif()
foreach(program IN LISTS programs)
    execute_process(COMMAND "${CMAKE_ARGV${last}}/${program}" OUTPUT_VARIABLE output
                    ERROR_VARIABLE error RESULT_VARIABLE failed)
    if(failed OR NOT output MATCHES "0\\.2 0" OR NOT error STREQUAL "")
        message(FATAL_ERROR "${program}: ${failed}, '${output}', '${error}'")
    endif()
endforeach()
