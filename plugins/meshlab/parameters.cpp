// Declares the parameters of the dialog and translates them to Roundel's options.

#include "parameters.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace {

enum Size { by_count, by_gradient, by_length };

/// The default number of quad edges along the diagonal of the bounding box.
constexpr float gradient_size = 30.0F;

const QStringList& sizes() {
    static const QStringList all{"number of quads", "gradient size", "edge length"};
    return all;
}

/// The strategies for integers, with the map's default first.
const QStringList& strategies() {
    static const QStringList all{"lattice", "adaptive", "greedy", "multiple",
                                 "direct",  "exact",    "auto"};
    return all;
}

/// The number with the shortest decimals that round to this float, which is what the user wrote. So
/// an edge length of 0.05 equals that of `roundel quad --edge-length 0.05`.
double as_written(float value) {
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    double number = value;
    std::from_chars(text.data(), end, number);
    return number;
}

std::string chosen(const RichParameterList& list, const char* name, const QStringList& from) {
    const int choice = list.getEnum(name);
    if (choice < 0 || choice >= from.size()) {
        throw std::invalid_argument(std::string(name) + ": choice " + std::to_string(choice) +
                                    " of 0 to " + std::to_string(from.size() - 1));
    }
    return from[choice].toStdString();
}

/// The description of a solver option, which includes its type.
roundel_option described(const std::string& name) {
    roundel_option option{};
    for (std::size_t i = 0; i < roundel_option_count(); ++i) {
        if (roundel_option_info(i, &option) == ROUNDEL_OK && name == option.name) {
            return option;
        }
    }
    throw std::invalid_argument("no option is called " + name);
}

/// Sets one option, given its name and its value as text.
void set(roundel::Options& options, const std::string& name, const QString& value) {
    bool is_number = true;
    switch (described(name).value_type) {
    case ROUNDEL_OPTION_INT:
        options.set(name, static_cast<std::int64_t>(value.toLongLong(&is_number)));
        break;
    case ROUNDEL_OPTION_REAL:
        options.set(name, value.toDouble(&is_number));
        break;
    default:
        options.set(name, value.toStdString());
    }
    if (!is_number) {
        throw std::invalid_argument("option " + name + ": " + value.toStdString() +
                                    " is not a number of its type");
    }
}

roundel::Options solver_options(const RichParameterList& list) {
    auto options = roundel::Options().set_strategy(chosen(list, "Strategy", strategies()));
    const auto words = list.getString("SolverOptions").simplified().split(' ');
    for (const QString& word : words) {
        if (word.isEmpty()) {
            continue;
        }
        const int equals = word.indexOf('=');
        if (equals < 1) {
            throw std::invalid_argument("expected NAME=VALUE, found " + word.toStdString());
        }
        set(options, word.left(equals).toStdString(), word.mid(equals + 1));
    }
    return options;
}

} // namespace

void declare_parameters(const MeshModel& mesh, RichParameterList& list) {
    const float diagonal = mesh.cm.bbox.Diag();
    list.addParam(RichEnum("Size", by_count, sizes(), "Size of quads by",
                           "Which of the next three fields gives the size of the quads."));
    list.addParam(RichInt("Quads", 1000, "Number of quads", "The approximate number of quads."));
    list.addParam(RichFloat("GradientSize", gradient_size, "Gradient size",
                            "The number of quad edges along the diagonal of the bounding box."));
    list.addParam(RichAbsPerc("EdgeLength", diagonal / gradient_size, 0.0F, diagonal, "Edge length",
                              "The length of the edges of the quads."));
    list.addParam(RichFloat("FeatureAngle", 0.0F, "Feature angle (degrees)",
                            "Edges at which the surface turns by this angle or more become chains "
                            "of quad edges; 0 for none."));
    list.addParam(RichBool("Boundary", true, "Follow the boundary",
                           "Boundary edges become chains of quad edges."));
    list.addParam(RichFloat("Detail", -1.0F, "Detail",
                            "Details smaller than this length attract no irregular vertices. A "
                            "negative number stands for a quarter of an edge."));
    list.addParam(RichEnum("Strategy", strategies().indexOf("lattice"), strategies(),
                           "Integers of the map", "How the integers of the map are decided."));
    list.addParam(RichEnum("FieldStrategy", strategies().indexOf("adaptive"), strategies(),
                           "Integers of the field", "How the integers of the field are decided."));
    list.addParam(RichBool("Untangle", true, "Untangle",
                           "Turn back flipped faces of the map, where quads need it."));
    list.addParam(RichBool("Smooth", true, "Smooth",
                           "Move vertices on the surface to make the quads more like squares of "
                           "one size."));
    list.addParam(
        RichString("SolverOptions", "", "Solver options",
                   "Further options of the solver as NAME=VALUE, separated by spaces, such as "
                   "time_limit=10 threads=2."));
}

roundel::QuadOptions quad_options(const MeshModel& mesh, const RichParameterList& list) {
    roundel::QuadOptions options;
    chosen(list, "Size", sizes());
    switch (list.getEnum("Size")) {
    case by_gradient:
        options.edge_length = mesh.cm.bbox.Diag() / as_written(list.getFloat("GradientSize"));
        break;
    case by_length:
        options.edge_length = as_written(list.getAbsPerc("EdgeLength"));
        break;
    default:
        const int quads = list.getInt("Quads");
        options.quads = quads > 0 ? static_cast<std::size_t>(quads) : 0;
    }
    const double angle = as_written(list.getFloat("FeatureAngle"));
    options.features = roundel::feature_angle(angle).set_boundary(list.getBool("Boundary"));
    const double detail = as_written(list.getFloat("Detail"));
    if (detail >= 0.0) {
        options.detail = detail;
    }
    options.solve = solver_options(list);
    options.field_strategy = chosen(list, "FieldStrategy", strategies());
    options.untangle = list.getBool("Untangle");
    options.smooth = list.getBool("Smooth");
    return options;
}
