// SPDX-License-Identifier: BSD-3-Clause
#include "centroid_shape.h"

WRONG_PLUGIN("wrong-fingerprint", static std::string other(toposcope::abi_fingerprint);
             other.replace(other.find("scalar=double"), 13, "scalar=single"); descriptor.fingerprint = other.c_str())
