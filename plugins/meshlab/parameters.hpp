// The parameters of the filter, and their translation to Roundel's options.

#ifndef ROUNDEL_MESHLAB_PARAMETERS_HPP
#define ROUNDEL_MESHLAB_PARAMETERS_HPP

#include "meshlab.hpp"

#include <roundel/roundel.hpp>

/// Adds the parameters of the dialog, with the defaults of `roundel quad`.
void declare_parameters(const MeshModel& mesh, RichParameterList& list);

/// The options that the dialog or a script sets; `solve` is always set. Throws
/// std::invalid_argument for a choice that does not exist and for text that is not an option. The
/// library checks the rest.
roundel::QuadOptions quad_options(const MeshModel& mesh, const RichParameterList& list);

#endif // ROUNDEL_MESHLAB_PARAMETERS_HPP
