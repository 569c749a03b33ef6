/// What a variable may be.

#ifndef COMISO_NSOLVER_VARIABLETYPE_HH
#define COMISO_NSOLVER_VARIABLETYPE_HH

#include <utility>

namespace COMISO {

enum VariableType { Real, Integer, Binary };

/// A variable and what it is; variables that are not named are real.
using PairUiV = std::pair<unsigned int, VariableType>;

} // namespace COMISO

#endif // COMISO_NSOLVER_VARIABLETYPE_HH
