# Packages have compressed manual pages, the same bytes each time.
file(GLOB_RECURSE pages "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*.1")
list(FILTER pages INCLUDE REGEX "/man1/")
foreach(page ${pages})
  execute_process(COMMAND gzip -9n ${page})
endforeach()
