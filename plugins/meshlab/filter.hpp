// The filter as a plugin of MeshLab since 2021 with one action.

#ifndef ROUNDEL_MESHLAB_FILTER_HPP
#define ROUNDEL_MESHLAB_FILTER_HPP

#include <common/plugins/interfaces/filter_plugin.h>

#include <QString>

/// Quadrangulates the current layer into a new layer.
class RoundelFilter : public QObject, public FilterPlugin {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
    Q_INTERFACES(FilterPlugin)

  public:
    enum { quadrangulate };

    RoundelFilter();

    QString pluginName() const override;
    QString vendor() const override;
    QString filterName(ActionIDType filter) const override;
    QString filterInfo(ActionIDType filter) const override;
    FilterClass getClass(const QAction* action) const override;
    FilterArity filterArity(const QAction* action) const override;
    int getPreConditions(const QAction* action) const override;
    int postCondition(const QAction* action) const override;
    RichParameterList initParameterList(const QAction* action, const MeshModel& mesh) override;
    /// Throws MLException with what to tell the user.
    std::map<std::string, QVariant> applyFilter(const QAction* action,
                                                const RichParameterList& list,
                                                MeshDocument& document, unsigned int& changed,
                                                vcg::CallBackPos* callback) override;
};

#endif // ROUNDEL_MESHLAB_FILTER_HPP
