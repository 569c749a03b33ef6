/// Includes GMM++ or its stand-in. Programs include this file for the matrices.

#ifndef COMISO_SOLVER_GMM_TOOLS_HH
#define COMISO_SOLVER_GMM_TOOLS_HH

#include <CoMISo/Config/config.hh>

#include <gmm/gmm.h>

// Programs use these two without including them.
#include <cmath>
#include <iostream>

#endif // COMISO_SOLVER_GMM_TOOLS_HH
