// cpp-httplib without the macro _res of <resolv.h>, which conflicts with names in Eigen.
#pragma once

#include <httplib.h>

#undef _res
