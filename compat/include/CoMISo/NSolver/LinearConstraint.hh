/// A linear constraint, given by its coefficients.

#ifndef COMISO_NSOLVER_LINEARCONSTRAINT_HH
#define COMISO_NSOLVER_LINEARCONSTRAINT_HH

#include <CoMISo/NSolver/NConstraintInterface.hh>

#include <vector>

namespace COMISO {

/// coeffs . x + b is equal to, at most or at least zero, so b is the negated right side.
class COMISODLLEXPORT LinearConstraint : public NConstraintInterface {
  public:
    using SVectorNC = NConstraintInterface::SVectorNC;

    explicit LinearConstraint(ConstraintType type = NC_EQUAL) : NConstraintInterface(type) {}
    LinearConstraint(const SVectorNC& coeffs, double b, ConstraintType type = NC_EQUAL)
        : NConstraintInterface(type), coeffs_(coeffs), b_(b) {}

    int n_unknowns() override { return static_cast<int>(coeffs_.innerSize()); }
    double eval_constraint(const double* x) override {
        double sum = b_;
        for (SVectorNC::InnerIterator it(coeffs_); it; ++it) {
            sum += it.value() * x[it.index()];
        }
        return sum;
    }
    void eval_gradient(const double* /*x*/, SVectorNC& gradient) override { gradient = coeffs_; }
    void eval_hessian(const double* /*x*/, SMatrixNC& hessian) override {
        hessian.resize(coeffs_.innerSize(), coeffs_.innerSize());
        hessian.setZero();
    }

    bool is_linear() const override { return true; }
    bool constant_gradient() const override { return true; }
    bool constant_hessian() const override { return true; }

    const SVectorNC& coeffs() const { return coeffs_; }
    SVectorNC& coeffs() { return coeffs_; }
    double b() const { return b_; }
    double& b() { return b_; }

    void resize(unsigned int unknowns) { coeffs_.resize(static_cast<Eigen::Index>(unknowns)); }
    void clear() {
        coeffs_.setZero();
        b_ = 0.0;
    }

  private:
    SVectorNC coeffs_;
    double b_ = 0.0;
};

} // namespace COMISO

#endif // COMISO_NSOLVER_LINEARCONSTRAINT_HH
