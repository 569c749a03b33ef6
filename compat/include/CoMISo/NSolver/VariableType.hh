/// The types of variables.

#ifndef COMISO_NSOLVER_VARIABLETYPE_HH
#define COMISO_NSOLVER_VARIABLETYPE_HH

#include <utility>

namespace COMISO {

enum VariableType { Real, Integer, Binary };

/// A variable and its type. Variables without such a pair are real.
using PairUiV = std::pair<unsigned int, VariableType>;

} // namespace COMISO

#endif // COMISO_NSOLVER_VARIABLETYPE_HH
