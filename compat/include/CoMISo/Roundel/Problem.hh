/// Translates problems from CoMISo's conventions to Roundel's.
///
/// The energy is x'Ax - 2 x'b. It is stationary where A x = b, so Q = 2A and q = -2b. A constraint
/// is a row of n + 1 numbers, c . x + c_{n+1} = 0. The last column of a least-squares matrix is
/// also the negated right side.

#ifndef COMISO_ROUNDEL_PROBLEM_HH
#define COMISO_ROUNDEL_PROBLEM_HH

#include <CoMISo/Roundel/Matrices.hh>

#include <roundel/roundel.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace COMISO {
namespace roundel_detail {

[[noreturn]] inline void refuse(roundel_status code, std::string message) {
    ::roundel::Status failure;
    failure.code = code;
    failure.message = std::move(message);
    throw ::roundel::Error(std::move(failure));
}

/// The rows of a matrix, with the last column separate.
struct Rows {
    std::vector<std::int64_t> offsets;
    std::vector<std::int64_t> indices;
    std::vector<double> values;
    /// The negated last column.
    std::vector<double> right;
};

/// The rows of a matrix that has one column more than there are unknowns.
inline Rows rows_of(const Entries& entries, std::size_t unknowns) {
    Rows rows;
    const auto last = static_cast<std::int64_t>(unknowns);
    rows.right.assign(entries.rows, 0.0);
    rows.offsets.assign(entries.rows + 1, 0);
    for (std::size_t k = 0; k < entries.value.size(); ++k) {
        const auto i = static_cast<std::size_t>(entries.row[k]);
        if (entries.col[k] == last) {
            rows.right[i] -= entries.value[k];
        } else {
            ++rows.offsets[i + 1];
        }
    }
    for (std::size_t i = 0; i < entries.rows; ++i) {
        rows.offsets[i + 1] += rows.offsets[i];
    }
    std::vector<std::int64_t> next(rows.offsets.begin(), rows.offsets.end() - 1);
    rows.indices.resize(static_cast<std::size_t>(rows.offsets.back()));
    rows.values.resize(rows.indices.size());
    for (std::size_t k = 0; k < entries.value.size(); ++k) {
        if (entries.col[k] != last) {
            const auto at =
                static_cast<std::size_t>(next[static_cast<std::size_t>(entries.row[k])]++);
            rows.indices[at] = entries.col[k];
            rows.values[at] = entries.value[k];
        }
    }
    return rows;
}

/// Adds the constraints. A matrix without rows may have any number of columns.
inline void constrain(::roundel::Problem& problem, const Entries& constraints,
                      std::size_t unknowns) {
    if (constraints.rows == 0) {
        return;
    }
    if (constraints.cols != unknowns + 1) {
        refuse(ROUNDEL_ERROR_LENGTH_MISMATCH,
               "the constraints have " + std::to_string(constraints.cols) +
                   " columns, and not the " + std::to_string(unknowns) +
                   " unknowns and one for the right side");
    }
    const Rows rows = rows_of(constraints, unknowns);
    const ::roundel::Compressed<std::int64_t> matrix{::roundel::Layout::rows, rows.offsets,
                                                     rows.indices, rows.values};
    problem.constrain(matrix, rows.right);
}

/// Adds the mean of A's two triangles, which should agree.
inline void add_quadratic(::roundel::Problem& problem, Entries&& matrix, std::size_t unknowns) {
    if (matrix.rows != unknowns || matrix.cols != unknowns) {
        refuse(ROUNDEL_ERROR_LENGTH_MISMATCH, "the matrix has " + std::to_string(matrix.rows) +
                                                  " rows and " + std::to_string(matrix.cols) +
                                                  " columns for " + std::to_string(unknowns) +
                                                  " unknowns");
    }
    for (std::size_t k = 0; k < matrix.value.size(); ++k) {
        if (matrix.row[k] == matrix.col[k]) {
            matrix.value[k] *= 2.0;
        } else if (matrix.row[k] < matrix.col[k]) {
            std::swap(matrix.row[k], matrix.col[k]);
        }
    }
    problem.quadratic(::roundel::Triangle::lower, ::roundel::span<const std::int64_t>(matrix.row),
                      ::roundel::span<const std::int64_t>(matrix.col), matrix.value);
}

/// The problem of a matrix A and a right side b.
inline ::roundel::Problem quadratic_problem(Entries&& matrix, const std::vector<double>& b) {
    ::roundel::Problem problem(b.size());
    add_quadratic(problem, std::move(matrix), b.size());
    std::vector<double> linear(b.size());
    std::transform(b.begin(), b.end(), linear.begin(), [](double v) { return -2.0 * v; });
    problem.linear(linear);
    return problem;
}

/// The problem that minimises the sum of squared rows, and the right side b of its normal equations
/// A x = b. `reg` times the mean of A's diagonal is added to that diagonal.
inline ::roundel::Problem least_squares_problem(const Entries& matrix, double reg,
                                                std::vector<double>& b) {
    if (matrix.cols < 2) {
        refuse(ROUNDEL_ERROR_LENGTH_MISMATCH,
               "the least-squares matrix needs a column for the right side beside the unknowns");
    }
    const std::size_t unknowns = matrix.cols - 1;
    const Rows rows = rows_of(matrix, unknowns);
    ::roundel::Problem problem(unknowns);
    b.assign(unknowns, 0.0);
    double trace = 0.0;
    std::vector<std::int32_t> indices;
    for (std::size_t i = 0; i < matrix.rows; ++i) {
        const auto begin = static_cast<std::size_t>(rows.offsets[i]);
        const auto end = static_cast<std::size_t>(rows.offsets[i + 1]);
        indices.clear();
        for (std::size_t k = begin; k < end; ++k) {
            indices.push_back(static_cast<std::int32_t>(rows.indices[k]));
            b[static_cast<std::size_t>(rows.indices[k])] += rows.values[k] * rows.right[i];
            trace += rows.values[k] * rows.values[k];
        }
        problem.least_squares(
            indices, ::roundel::span<const double>(rows.values.data() + begin, end - begin),
            rows.right[i]);
    }
    if (reg != 0.0) {
        Entries diagonal;
        for (std::size_t i = 0; i < unknowns; ++i) {
            diagonal.add(i, i, 2.0 * reg * trace / static_cast<double>(unknowns));
        }
        problem.quadratic(::roundel::Triangle::lower,
                          ::roundel::span<const std::int64_t>(diagonal.row),
                          ::roundel::span<const std::int64_t>(diagonal.col), diagonal.value);
    }
    return problem;
}

/// Makes unknowns integer; duplicates are allowed.
template <class Indices> bool make_integer(::roundel::Problem& problem, const Indices& indices) {
    std::vector<std::int32_t> integers;
    for (const auto& index : indices) {
        integers.push_back(static_cast<std::int32_t>(index));
    }
    problem.integer(integers);
    return !integers.empty();
}

} // namespace roundel_detail
} // namespace COMISO

#endif // COMISO_ROUNDEL_PROBLEM_HH
