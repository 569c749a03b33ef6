// Reads free-format MPS, as the library writes it, into GMM's matrices and evaluates their
// energies.

#include "problem.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

namespace {

struct Entry {
    std::size_t row;
    std::size_t column;
    double value;
};

// The sections of a file, with unknowns, rows and entries by number.
struct Sections {
    std::map<std::string, std::size_t> rows;
    std::map<std::string, std::size_t> columns;
    std::string objective;
    std::vector<Entry> constraints;
    std::vector<Entry> hessian;
    std::map<std::size_t, double> linear;
    std::map<std::size_t, double> right;
    std::vector<int> integers;
    double constant = 0.0;

    std::size_t column(const std::string& name, bool integer) {
        const auto [at, is_new] = columns.try_emplace(name, columns.size());
        if (is_new && integer) {
            integers.push_back(static_cast<int>(at->second));
        }
        return at->second;
    }
};

void read_line(Sections& to, const std::string& section, const std::vector<std::string>& words,
               bool& integer) {
    if (section == "ROWS") {
        if (words[0] == "N") {
            to.objective = words[1];
        } else {
            to.rows.emplace(words[1], to.rows.size());
        }
    } else if (section == "COLUMNS" && words[1] == "'MARKER'") {
        integer = words[2] == "'INTORG'";
    } else if (section == "COLUMNS") {
        const std::size_t j = to.column(words[0], integer);
        for (std::size_t k = 1; k + 1 < words.size(); k += 2) {
            const double value = std::stod(words[k + 1]);
            if (words[k] == to.objective) {
                to.linear[j] += value;
            } else {
                to.constraints.push_back({to.rows.at(words[k]), j, value});
            }
        }
    } else if (section == "RHS") {
        for (std::size_t k = words.size() % 2; k + 1 < words.size(); k += 2) {
            const double value = std::stod(words[k + 1]);
            if (words[k] == to.objective) {
                to.constant = -value;
            } else {
                to.right[to.rows.at(words[k])] = value;
            }
        }
    } else if (section == "QUADOBJ") {
        to.hessian.push_back(
            {to.columns.at(words[0]), to.columns.at(words[1]), std::stod(words[2])});
    }
}

Sections read(const std::string& file) {
    Sections sections;
    std::ifstream lines(file);
    std::string line;
    std::string section;
    bool integer = false;
    while (std::getline(lines, line)) {
        std::istringstream stream(line);
        std::vector<std::string> words;
        for (std::string word; stream >> word;) {
            words.push_back(word);
        }
        if (words.empty() || line[0] == '*') {
            continue;
        }
        if (line[0] != ' ') {
            section = words[0];
        } else {
            read_line(sections, section, words, integer);
        }
    }
    return sections;
}

} // namespace

GmmProblem in_gmm(const roundel::Problem& problem, const std::string& scratch) {
    problem.write_mps(scratch);
    const Sections sections = read(scratch);
    const std::size_t n = sections.columns.size();
    GmmProblem to;
    gmm::resize(to.A, n, n);
    gmm::resize(to.C, sections.rows.size(), n + 1);
    to.b.assign(n, 0.0);
    // 1/2 x'Qx + q'x equals x'Ax - 2 x'b with A = Q / 2 and b = -q / 2. The file has one triangle
    // of Q.
    for (const Entry& entry : sections.hessian) {
        to.A(entry.row, entry.column) += 0.5 * entry.value;
        if (entry.row != entry.column) {
            to.A(entry.column, entry.row) += 0.5 * entry.value;
        }
    }
    for (const auto& [j, value] : sections.linear) {
        to.b[j] = -0.5 * value;
    }
    for (const Entry& entry : sections.constraints) {
        to.C(entry.row, entry.column) += entry.value;
    }
    for (const auto& [i, value] : sections.right) {
        to.C(i, n) = -value;
    }
    to.integers = sections.integers;
    to.constant = sections.constant;
    return to;
}

double GmmProblem::energy(const std::vector<double>& x) const {
    double sum = constant;
    for (std::size_t j = 0; j < x.size(); ++j) {
        double product = 0.0;
        for (const auto& [i, value] : A[j]) {
            product += value * x[i];
        }
        sum += x[j] * (product - 2.0 * b[j]);
    }
    return sum;
}

double GmmProblem::violation(const std::vector<double>& x) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < C.nrows(); ++i) {
        double sum = 0.0;
        for (const auto& [j, value] : C[i]) {
            sum += value * (j < x.size() ? x[j] : 1.0);
        }
        largest = std::max(largest, std::abs(sum));
    }
    for (int i : integers) {
        const double value = x[static_cast<std::size_t>(i)];
        largest = std::max(largest, std::abs(value - std::round(value)));
    }
    return largest;
}
