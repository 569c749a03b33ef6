// Shows Roundel's events in MeshLab's progress bar, and passes its cancel button to Roundel.

#ifndef ROUNDEL_MESHLAB_PROGRESS_HPP
#define ROUNDEL_MESHLAB_PROGRESS_HPP

#include <roundel/roundel.hpp>

#include <wrap/callback.h>

#include <algorithm>

/// A progress bar that never goes back, although field and map are solved one after the other and
/// some problems are solved several times.
class Progress {
  public:
    explicit Progress(vcg::CallBackPos* callback) : callback_(callback) {}

    /// Whether the callback has asked to stop by returning false.
    bool is_cancelled() const { return cancelled_; }

    roundel::Flow tell(const roundel::Event& event) {
        const Part part = part_of(event.phase);
        if (event.kind == roundel::EventKind::progress) {
            const double here = part.from + event.fraction * (part.to - part.from);
            percent_ = std::max(percent_, static_cast<int>(here));
        }
        cancelled_ = cancelled_ || (callback_ && !callback_(percent_, part.text));
        return cancelled_ ? roundel::stop : roundel::go_on;
    }

  private:
    struct Part {
        double from, to;
        const char* text;
    };

    static Part part_of(roundel::Phase phase) {
        switch (phase) {
        case roundel::Phase::eliminate:
            return {0, 5, "Roundel: constraints"};
        case roundel::Phase::factor:
            return {5, 15, "Roundel: factorization"};
        case roundel::Phase::round:
            return {15, 60, "Roundel: integers"};
        case roundel::Phase::untangle:
            return {60, 80, "Roundel: untangling"};
        case roundel::Phase::quads:
            return {80, 100, "Roundel: quads"};
        case roundel::Phase::none:
            break;
        }
        return {0, 0, "Roundel"};
    }

    vcg::CallBackPos* callback_;
    int percent_ = 0;
    bool cancelled_ = false;
};

#endif // ROUNDEL_MESHLAB_PROGRESS_HPP
