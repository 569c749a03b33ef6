/// A stand-in for the part of GMM++'s interface that programs for CoMISo use: sparse matrices that
/// are filled entry by entry, and what is computed with them. It contains no code of GMM++.
///
/// If the real GMM++ was included before, this file is empty. To use the real one instead, leave
/// this directory out of the include path (see docs/comiso.md).

#if !defined(GMM_KERNEL_H__) && !defined(ROUNDEL_GMM_SHIM)
#define ROUNDEL_GMM_SHIM 1

// Programs use these two without including them.
#include <cmath>
#include <iostream>

#include <gmm/shim/columns.h>
#include <gmm/shim/compressed.h>
#include <gmm/shim/matrices.h>
#include <gmm/shim/operations.h>
#include <gmm/shim/vectors.h>
#include <gmm/shim/views.h>

#endif
