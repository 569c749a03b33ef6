/// An objective that computes its value, gradient and Hessian.

#ifndef COMISO_NSOLVER_NPROBLEMINTERFACE_HH
#define COMISO_NSOLVER_NPROBLEMINTERFACE_HH

#include <CoMISo/Config/CoMISoDefines.hh>
#include <CoMISo/Config/config.hh>

#include <Eigen/SparseCore>

namespace COMISO {

/// Programs implement this. All arrays have n_unknowns() numbers.
class COMISODLLEXPORT NProblemInterface {
  public:
    using SMatrixNP = Eigen::SparseMatrix<double, Eigen::ColMajor>;

    NProblemInterface() = default;
    NProblemInterface(const NProblemInterface&) = default;
    NProblemInterface& operator=(const NProblemInterface&) = default;
    virtual ~NProblemInterface() = default;

    virtual int n_unknowns() = 0;
    virtual void initial_x(double* x) = 0;
    virtual double eval_f(const double* x) = 0;
    virtual void eval_gradient(const double* x, double* gradient) = 0;
    virtual void eval_hessian(const double* x, SMatrixNP& hessian) = 0;
    /// Receives the solution.
    virtual void store_result(const double* x) = 0;

    virtual bool constant_gradient() const { return false; }
    virtual bool constant_hessian() const { return false; }
};

} // namespace COMISO

#endif // COMISO_NSOLVER_NPROBLEMINTERFACE_HH
