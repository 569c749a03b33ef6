# Runs the consumers in the directory that the last argument names, and checks their output.

math(EXPR last "${CMAKE_ARGC} - 1")
foreach(program IN ITEMS c_consumer cpp_consumer)
    execute_process(COMMAND "${CMAKE_ARGV${last}}/${program}" OUTPUT_VARIABLE output
                    ERROR_VARIABLE error RESULT_VARIABLE failed)
    if(failed OR NOT output MATCHES "0\\.2 0" OR NOT error STREQUAL "")
        message(FATAL_ERROR "${program}: ${failed}, '${output}', '${error}'")
    endif()
endforeach()
