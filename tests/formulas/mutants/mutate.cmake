# Writes the file FROM to TO with TEXT, which must stand there exactly once, replaced by REPLACEMENT.
file(READ ${FROM} content)
string(FIND "${content}" "${TEXT}" first)
string(FIND "${content}" "${TEXT}" last REVERSE)
if(first EQUAL -1 OR NOT first EQUAL last)
  message(FATAL_ERROR "\"${TEXT}\" does not stand exactly once in ${FROM}: choose another text in tests/CMakeLists.txt")
endif()
string(REPLACE "${TEXT}" "${REPLACEMENT}" damaged "${content}")
file(WRITE ${TO} "${damaged}")
