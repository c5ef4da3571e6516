// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "model/model.h"

namespace toposcope {

/// What it costs to find 0, 1, 2, ... instances of a family, in nats: minus the log of k! P(k), since k instances may
/// be exchanged with each other. P(k) is the probability that of n instances k are found, each with the same
/// detectability. n is as likely as any other that the model allows; of any number, m more than must be there has
/// probability 1/((m + 1) (m + 2)), which is a distribution without a scale. \param detectability  above 0 and below 1
/// \param worth          nats that each instance costs that must be there and is not found
/// \param most_found     no more can be found
std::vector<double> number_costs(const InstanceCount& count, double detectability, double worth, Index most_found);

}  // namespace toposcope
