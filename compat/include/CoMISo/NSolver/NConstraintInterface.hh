/// A constraint that computes its value, gradient and Hessian.

#ifndef COMISO_NSOLVER_NCONSTRAINTINTERFACE_HH
#define COMISO_NSOLVER_NCONSTRAINTINTERFACE_HH

#include <CoMISo/Config/CoMISoDefines.hh>
#include <CoMISo/Config/config.hh>

#include <Eigen/SparseCore>

namespace COMISO {

/// Programs implement this. eval_constraint(x) is equal to, at most or at least zero.
class COMISODLLEXPORT NConstraintInterface {
  public:
    using SVectorNC = Eigen::SparseVector<double>;
    using SMatrixNC = Eigen::SparseMatrix<double, Eigen::ColMajor>;

    enum ConstraintType { NC_EQUAL, NC_LESS_EQUAL, NC_GREATER_EQUAL };

    explicit NConstraintInterface(ConstraintType type = NC_EQUAL) : type_(type) {}
    NConstraintInterface(const NConstraintInterface&) = default;
    NConstraintInterface& operator=(const NConstraintInterface&) = default;
    virtual ~NConstraintInterface() = default;

    virtual int n_unknowns() = 0;
    virtual double eval_constraint(const double* x) = 0;
    virtual void eval_gradient(const double* x, SVectorNC& gradient) = 0;
    virtual void eval_hessian(const double* x, SMatrixNC& hessian) = 0;

    virtual ConstraintType constraint_type() { return type_; }
    virtual bool is_linear() const { return false; }
    virtual bool constant_gradient() const { return false; }
    virtual bool constant_hessian() const { return false; }

  private:
    ConstraintType type_;
};

} // namespace COMISO

#endif // COMISO_NSOLVER_NCONSTRAINTINTERFACE_HH
