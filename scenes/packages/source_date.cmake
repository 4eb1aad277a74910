# The time that files of the build contain, if any: SOURCE_DATE_EPOCH in the environment, otherwise the time
# of the last commit, or the start of 1980 for sources without commits. cpack reads it, too.
set(source ${CMAKE_CURRENT_LIST_DIR}/../..)
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  set(commit_date "")
  if(EXISTS ${source}/.git)
    execute_process(COMMAND git -C ${source} log -1 --format=%ct
                    OUTPUT_VARIABLE commit_date OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
  if(NOT commit_date MATCHES "^[0-9]+$")
    set(commit_date 315532800)
  endif()
  set(ENV{SOURCE_DATE_EPOCH} ${commit_date})
endif()
