// The plugin of MeshLab since 2021, whose failures are exceptions.

#include "filter.hpp"

#include "action.hpp"
#include "parameters.hpp"

#include <common/mlexception.h>

#include <QAction>

#include <exception>

RoundelFilter::RoundelFilter() {
    typeList = {quadrangulate};
    for (const ActionIDType type : types()) {
        actionList.push_back(new QAction(filterName(type), this));
    }
}

QString RoundelFilter::pluginName() const {
    return "FilterRoundel";
}

QString RoundelFilter::vendor() const {
    return "Roundel";
}

QString RoundelFilter::filterName(ActionIDType) const {
    return action::name();
}

QString RoundelFilter::filterInfo(ActionIDType) const {
    return action::description();
}

FilterPlugin::FilterClass RoundelFilter::getClass(const QAction*) const {
    return FilterClass(Remeshing | Polygonal);
}

FilterPlugin::FilterArity RoundelFilter::filterArity(const QAction*) const {
    return SINGLE_MESH;
}

int RoundelFilter::getPreConditions(const QAction*) const {
    return MeshModel::MM_FACENUMBER;
}

int RoundelFilter::postCondition(const QAction*) const {
    return MeshModel::MM_NONE;
}

RichParameterList RoundelFilter::initParameterList(const QAction*, const MeshModel& mesh) {
    RichParameterList list;
    declare_parameters(mesh, list);
    return list;
}

std::map<std::string, QVariant> RoundelFilter::applyFilter(const QAction*,
                                                           const RichParameterList& list,
                                                           MeshDocument& document, unsigned int&,
                                                           vcg::CallBackPos* callback) {
    try {
        log(GLLogStream::FILTER, action::run(document, list, callback).toStdString());
        return {};
    } catch (const std::exception& error) {
        throw MLException(QString::fromUtf8(error.what()));
    }
}
