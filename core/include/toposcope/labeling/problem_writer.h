// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Labelling problems as toulbar2 and others read them. Exclusions become hard functions over two variables, forbidden
// entries costs that reach the bound; violations and detectabilities are left out.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "toposcope/labeling.h"

namespace toposcope {

/// The text of a problem file and how its costs stand to the problem's.
struct WrittenProblem {
  std::string text;   ///< of the file
  int decimals = 0;   ///< .cfn: digits after the point; .wcsp: costs are multiplied by 10 to this power
  bool exact = true;  ///< false: costs are rounded to that
  double shift = 0;   ///< .wcsp: added to a labelling's cost before it is multiplied, so that no cost is negative
};

/// Cost function network (.cfn): names, value names, decimal and negative costs. Characters that the format does not
/// allow in names become '_', and names that would be equal are numbered.
/// \param upper_bound  labellings of this cost or more are no solutions
/// \param maximize     writes minus the costs, to be maximised
/// \param stop         asked before each function; once true, the text is left unfinished
/// \throw std::invalid_argument  `check(problem)` fails, or costs are too large for 15 digits
WrittenProblem write_cfn(const LabelingProblem& problem, double upper_bound = std::numeric_limits<double>::infinity(),
                         bool maximize = false, const std::function<bool()>& stop = {});

/// Weighted CSP (.wcsp): integer costs, no names.
/// \throw std::invalid_argument  as above
WrittenProblem write_wcsp(const LabelingProblem& problem, double upper_bound = std::numeric_limits<double>::infinity());

/// Markov network (.uai): factors are exp(-cost), forbidden ones 0. No names, no bound.
/// \throw std::invalid_argument  `check(problem)` fails, or a finite cost whose factor no number can hold (beyond 700)
WrittenProblem write_uai(const LabelingProblem& problem);

}  // namespace toposcope
