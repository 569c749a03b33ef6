//! The options of repair, in one table.

use crate::search::table::options;

options! {
    /// What repair may do beyond what the strict mesh needs. By default it welds equal positions only,
    /// drops no component and fills no hole.
    pub struct RepairOptions,

    /// The options of repair.
    REPAIR_OPTIONS {
        /// Chains of such vertices become one vertex, so that the result does not depend on their order.
        weld: f64 = 0.0, "0" in "[0, inf)",
            "the distance up to which vertices are welded, in units of the mesh; at 0, those of equal position";
        drop_components: f64 = 0.0, "0" in "[0, 1]",
            "the share of the area below which a component is dropped; 0 keeps all";
        fill_holes: usize = 0, "0" in "[0, 1000]",
            "the largest number of edges of a hole that is filled; 0 fills none";
    }
    and {}
    by {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::search::table::hold;

    #[test]
    fn every_option_of_the_table_starts_at_its_default_and_comes_back_as_set() {
        hold(REPAIR_OPTIONS, RepairOptions::set, RepairOptions::get);
    }
}
