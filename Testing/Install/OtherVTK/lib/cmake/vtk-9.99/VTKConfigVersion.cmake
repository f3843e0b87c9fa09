# Fits a version that is asked for alone, as VTK's own, and no range that ends before it.
set(PACKAGE_VERSION 9.99.0)
if (NOT PACKAGE_FIND_VERSION_RANGE)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif ()
