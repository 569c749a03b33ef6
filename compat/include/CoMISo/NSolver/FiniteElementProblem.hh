/// An objective that is a sum of elements with few unknowns each.

#ifndef COMISO_NSOLVER_FINITEELEMENTPROBLEM_HH
#define COMISO_NSOLVER_FINITEELEMENTPROBLEM_HH

#include <CoMISo/NSolver/NProblemInterface.hh>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace COMISO {

/// The functions that a problem calls on a set of elements.
class COMISODLLEXPORT FiniteElementSetBase {
  public:
    using Triplet = Eigen::Triplet<double>;

    FiniteElementSetBase() = default;
    FiniteElementSetBase(const FiniteElementSetBase&) = default;
    FiniteElementSetBase& operator=(const FiniteElementSetBase&) = default;
    virtual ~FiniteElementSetBase() = default;

    virtual double eval_f(const double* x) = 0;
    /// Adds to `gradient`.
    virtual void accumulate_gradient(const double* x, double* gradient) = 0;
    /// Appends to `triplets`.
    virtual void accumulate_hessian(const double* x, std::vector<Triplet>& triplets) = 0;
};

/// Elements of one type. The type has the constants NV and NC, the types VecI (NV indices), VecV
/// (NV numbers), VecC (NC numbers) and Triplet, and the functions `eval_f(x, c)`, `eval_gradient(x,
/// c, gradient)` and `eval_hessian(x, c, triplets)` in its own NV unknowns.
template <class FiniteElementType> class FiniteElementSet : public FiniteElementSetBase {
  public:
    using VecI = typename FiniteElementType::VecI;
    using VecV = typename FiniteElementType::VecV;
    using VecC = typename FiniteElementType::VecC;

    /// The elements: the unknowns of the problem that each uses, and its constants.
    class Instances {
      public:
        void add_element(const VecI& indices, const VecC& constants) {
            indices_.push_back(indices);
            constants_.push_back(constants);
        }
        void clear_elements() {
            indices_.clear();
            constants_.clear();
        }
        std::size_t size() const { return indices_.size(); }
        /// The k-th unknown of element `element`.
        std::size_t index(std::size_t element, std::size_t k) const {
            return static_cast<std::size_t>(indices_[element][static_cast<Eigen::Index>(k)]);
        }
        const VecC& c(std::size_t element) const { return constants_[element]; }

      private:
        std::vector<VecI> indices_;
        std::vector<VecC> constants_;
    };

    FiniteElementSet() = default;
    explicit FiniteElementSet(const FiniteElementType& element) : element_(element) {}

    FiniteElementType& element() { return element_; }
    Instances& instances() { return instances_; }
    const Instances& instances() const { return instances_; }

    double eval_f(const double* x) override {
        double sum = 0.0;
        for (std::size_t e = 0; e < instances_.size(); ++e) {
            sum += element_.eval_f(local(e, x), instances_.c(e));
        }
        return sum;
    }

    void accumulate_gradient(const double* x, double* gradient) override {
        VecV part;
        for (std::size_t e = 0; e < instances_.size(); ++e) {
            part.setZero();
            element_.eval_gradient(local(e, x), instances_.c(e), part);
            for (std::size_t k = 0; k < unknowns; ++k) {
                gradient[instances_.index(e, k)] += part[static_cast<Eigen::Index>(k)];
            }
        }
    }

    void accumulate_hessian(const double* x, std::vector<Triplet>& triplets) override {
        std::vector<typename FiniteElementType::Triplet> part;
        for (std::size_t e = 0; e < instances_.size(); ++e) {
            part.clear();
            element_.eval_hessian(local(e, x), instances_.c(e), part);
            for (const auto& entry : part) {
                triplets.emplace_back(place(e, entry.row()), place(e, entry.col()), entry.value());
            }
        }
    }

  private:
    static constexpr auto unknowns = static_cast<std::size_t>(FiniteElementType::NV);

    VecV local(std::size_t element, const double* x) const {
        VecV values;
        for (std::size_t k = 0; k < unknowns; ++k) {
            values[static_cast<Eigen::Index>(k)] = x[instances_.index(element, k)];
        }
        return values;
    }

    int place(std::size_t element, int k) const {
        return static_cast<int>(instances_.index(element, static_cast<std::size_t>(k)));
    }

    FiniteElementType element_;
    Instances instances_;
};

/// The sum of several sets of elements. The problem does not own the sets.
class COMISODLLEXPORT FiniteElementProblem : public NProblemInterface {
  public:
    explicit FiniteElementProblem(unsigned int n) : x_(n, 0.0) {}

    void add_set(FiniteElementSetBase* set) { sets_.push_back(set); }
    void clear_sets() { sets_.clear(); }

    /// The stored solution.
    std::vector<double>& x() { return x_; }

    int n_unknowns() override { return static_cast<int>(x_.size()); }
    void initial_x(double* x) override { std::copy(x_.begin(), x_.end(), x); }
    double eval_f(const double* x) override {
        double sum = 0.0;
        for (FiniteElementSetBase* set : sets_) {
            sum += set->eval_f(x);
        }
        return sum;
    }
    void eval_gradient(const double* x, double* gradient) override {
        std::fill(gradient, gradient + x_.size(), 0.0);
        for (FiniteElementSetBase* set : sets_) {
            set->accumulate_gradient(x, gradient);
        }
    }
    void eval_hessian(const double* x, SMatrixNP& hessian) override {
        std::vector<FiniteElementSetBase::Triplet> triplets;
        for (FiniteElementSetBase* set : sets_) {
            set->accumulate_hessian(x, triplets);
        }
        hessian.resize(n_unknowns(), n_unknowns());
        hessian.setFromTriplets(triplets.begin(), triplets.end());
    }
    void store_result(const double* x) override { x_.assign(x, x + x_.size()); }

  private:
    std::vector<double> x_;
    std::vector<FiniteElementSetBase*> sets_;
};

} // namespace COMISO

#endif // COMISO_NSOLVER_FINITEELEMENTPROBLEM_HH
