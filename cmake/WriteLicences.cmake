# cmake -DPYTHON=... -DSOURCE=... -DFILE=... -P WriteLicences.cmake
#
# Writes the texts of the licences of all that is linked in. A build does not fail for want of them.
if("${FILE}" IS_NEWER_THAN "${SOURCE}/Cargo.lock" AND EXISTS "${FILE}")
    return()
endif()
execute_process(COMMAND "${PYTHON}" "${SOURCE}/scripts/third-party" --texts "${FILE}"
                RESULT_VARIABLE status ERROR_VARIABLE told)
if(NOT status EQUAL 0)
    file(REMOVE "${FILE}")
    message(WARNING "What is installed will lack the licences of what is linked in, "
                    "so it cannot be given to others: ${told}")
endif()
