// A host for the plugin: it calls the plugin as MeshLab does, and tests cancelling, which
// meshlabserver cannot do.

#include "../meshlab.hpp"

#ifndef ROUNDEL_MESHLAB_2020
#include <common/mlexception.h>
#endif

#include <vcg/complex/algorithms/create/platonic.h>
#include <vcg/complex/algorithms/update/bounding.h>

#include <QApplication>
#include <QFileInfo>
#include <QPluginLoader>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition);                   \
            std::exit(1);                                                                          \
        }                                                                                          \
    } while (false)

namespace {

std::vector<int> percents;
int calls_until_cancel = -1;

bool callback(const int percent, const char*) {
    percents.push_back(percent);
    return calls_until_cancel < 0 || static_cast<int>(percents.size()) <= calls_until_cancel;
}

/// A document that contains a torus.
struct Torus {
    MeshDocument document;

    Torus() {
        MeshModel& model = *document.addNewMesh("", "torus", true);
        vcg::tri::Torus(model.cm, 2.0F, 0.7F, 40, 20);
        vcg::tri::UpdateBounding<CMeshO>::Box(model.cm);
    }
};

#ifdef ROUNDEL_MESHLAB_2020

using Filter = MeshFilterInterface;

std::size_t layers(const MeshDocument& document) {
    return static_cast<std::size_t>(document.size());
}

struct Host {
    Filter* filter;
    QAction* action;
    mutable QString message;

    RichParameterList defaults(Torus& torus) const {
        RichParameterList list;
        filter->initParameterSet(action, torus.document, list);
        return list;
    }

    bool apply(Torus& torus, const RichParameterList& list) const {
        percents.clear();
        const bool good = filter->applyFilter(action, torus.document, list, callback);
        message = filter->errorMsg();
        return good;
    }
};

#else

using Filter = FilterPlugin;
using EnumValue = IntValue;
using AbsPercValue = FloatValue;

std::size_t layers(const MeshDocument& document) {
    return document.meshNumber();
}

struct Host {
    Filter* filter;
    QAction* action;
    mutable QString message;

    RichParameterList defaults(Torus& torus) const {
        return filter->initParameterList(action, torus.document);
    }

    bool apply(Torus& torus, const RichParameterList& list) const {
        percents.clear();
        unsigned int changed = 0;
        try {
            filter->applyFilter(action, list, torus.document, changed, callback);
            return true;
        } catch (const MLException& error) {
            message = QString::fromLocal8Bit(error.what());
            return false;
        }
    }
};

#endif

void makes_a_layer_of_pairs_of_triangles(const Host& host) {
    Torus torus;
    auto list = host.defaults(torus);
    list.setValue("Quads", IntValue(300));
    torus.document.mm()->cm.Tr.SetTranslate(1.0F, 2.0F, 3.0F);
    const auto placement = torus.document.mm()->cm.Tr;
    CHECK(host.apply(torus, list));
    CHECK(layers(torus.document) == 2);
    MeshModel& layer = *torus.document.mm();
    CHECK(layer.label() == "torus quads" && layer.cm.Tr == placement);
    CHECK(layer.hasDataMask(MeshModel::MM_POLYGONAL));
    const int faces = layer.cm.fn;
    CHECK(faces > 2 * 200 && faces < 2 * 400 && faces == 2 * layer.cm.vn);
    for (int f = 0; f < faces; f += 2) {
        const auto &one = layer.cm.face[f], &other = layer.cm.face[f + 1];
        CHECK(one.IsF(2) && !one.IsF(0) && !one.IsF(1));
        CHECK(other.IsF(0) && !other.IsF(1) && !other.IsF(2));
        CHECK(one.cV(0) == other.cV(0) && one.cV(2) == other.cV(1));
        CHECK(one.cN() == other.cN());
    }
    // The bar moves and does not go back.
    CHECK(percents.size() > 10 && percents.front() >= 0 && percents.back() <= 100);
    CHECK(std::is_sorted(percents.begin(), percents.end()) && percents.front() < percents.back());
}

void sizes_agree_however_they_are_said(const Host& host) {
    int vertices[2];
    for (const int by : {1, 2}) {
        Torus torus;
        const float diagonal = torus.document.mm()->cm.bbox.Diag();
        auto list = host.defaults(torus);
        list.setValue("Size", EnumValue(by));
        list.setValue("GradientSize", FloatValue(16.0F));
        list.setValue("EdgeLength", AbsPercValue(diagonal / 16.0F));
        CHECK(host.apply(torus, list));
        vertices[by - 1] = torus.document.mm()->cm.vn;
    }
    CHECK(vertices[0] == vertices[1] && vertices[0] > 100 && vertices[0] < 1000);
}

void a_cancel_leaves_no_layer(const Host& host) {
    for (const int calls : {0, 3, 10}) {
        Torus torus;
        calls_until_cancel = calls;
        CHECK(!host.apply(torus, host.defaults(torus)));
        calls_until_cancel = -1;
        CHECK(host.message == "cancelled");
        CHECK(layers(torus.document) == 1);
    }
}

void errors_are_messages(const Host& host) {
    const auto refused = [&](const char* name, const Value& value) {
        Torus torus;
        auto list = host.defaults(torus);
        list.setValue(name, value);
        CHECK(!host.apply(torus, list));
        CHECK(layers(torus.document) == 1);
        return host.message;
    };
    CHECK(refused("Quads", IntValue(0)).contains("option 'quads': 0 is outside"));
    CHECK(refused("Quads", IntValue(-5)).contains("option 'quads': 0 is outside"));
    CHECK(refused("FeatureAngle", FloatValue(-1.0F)).contains("option 'feature_angle'"));
    CHECK(refused("Strategy", EnumValue(99)) == "Strategy: choice 99 of 0 to 6");
    CHECK(refused("SolverOptions", StringValue("speed=3")) == "no option is called speed");
    CHECK(refused("SolverOptions", StringValue("speed")) == "expected NAME=VALUE, found speed");
    CHECK(refused("SolverOptions", StringValue("threads=few")).contains("not a number"));
    CHECK(refused("SolverOptions", StringValue("threads=-1")).contains("threads"));

    // An invalid mesh: three triangles share an edge.
    Torus torus;
    auto& mesh = torus.document.mm()->cm;
    mesh.face[0].V(2) = mesh.face[200].V(2);
    CHECK(!host.apply(torus, host.defaults(torus)) && !host.message.isEmpty());
}

} // namespace

int main(int count, char** words) {
    QApplication application(count, words);
    CHECK(count == 2);
    QPluginLoader loader(QFileInfo(words[1]).absoluteFilePath());
    QObject* plugin = loader.instance();
    if (!plugin) {
        std::fprintf(stderr, "%s\n", qUtf8Printable(loader.errorString()));
        return 1;
    }
    auto* filter = qobject_cast<Filter*>(plugin);
    CHECK(filter && filter->actions().size() == 1);
    const Host host{filter, filter->actions().front(), QString()};
    makes_a_layer_of_pairs_of_triangles(host);
    sizes_agree_however_they_are_said(host);
    a_cancel_leaves_no_layer(host);
    errors_are_messages(host);
    std::puts("the plugin loads, makes quads, cancels and tells errors");
    return 0;
}
