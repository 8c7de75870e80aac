// cpp-httplib, without the macro _res of <resolv.h>, which it brings along and Eigen cannot bear.
#pragma once

#include <httplib.h>

#undef _res
