# cmake -DPYTHON=... -DSCRIPT=.../third-party -DFILE=... -P WriteLicences.cmake
#
# Writes the texts of the licences of all that is linked in. A build does not fail for want of them.
execute_process(COMMAND "${PYTHON}" "${SCRIPT}" --texts "${FILE}" RESULT_VARIABLE status ERROR_VARIABLE told)
if(NOT status EQUAL 0)
    file(REMOVE "${FILE}")
    message(WARNING "What is installed will lack the licences of what is linked in, "
                    "so it cannot be given to others: ${told}")
endif()
