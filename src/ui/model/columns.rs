//! The order of the table's columns, as it is remembered.

use super::{Column, Model};

impl Model {
    /// The columns from left to right. Unknown names in the configuration are left out; a column that it lacks comes
    /// last.
    pub fn columns(&self) -> Vec<Column> {
        let mut columns: Vec<Column> = Vec::with_capacity(Column::ALL.len());
        let remembered = self.options.window.column_order.iter().filter_map(|key| Column::from_key(key));
        for column in remembered.chain(Column::ALL) {
            if !columns.contains(&column) {
                columns.push(column);
            }
        }
        columns
    }

    /// Moves a column so that it stands before the one that is at `position` now; at the end if there is none.
    pub(in crate::ui) fn move_column(&mut self, column: Column, position: usize) {
        let mut columns = self.columns();
        let Some(from) = columns.iter().position(|c| *c == column) else { return };
        columns.remove(from);
        let to = if position > from { position - 1 } else { position };
        columns.insert(to.min(columns.len()), column);
        self.options.window.column_order = columns.iter().map(|column| column.key().to_owned()).collect();
        self.unsaved = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Language, clock};
    use crate::workspace::{Configuration, Workspace};

    #[test]
    fn a_column_goes_before_the_one_at_the_position() {
        let mut model = Model::new(Configuration::default(), Workspace::new("/nowhere"), Language::En, clock::now());
        assert_eq!(model.columns(), Column::ALL);
        model.move_column(Column::Status, 0);
        assert_eq!(model.columns()[..3], [Column::Status, Column::Name, Column::Type]);
        model.move_column(Column::Status, 2);
        assert_eq!(model.columns()[..3], [Column::Name, Column::Status, Column::Type]);
        model.move_column(Column::Name, Column::ALL.len());
        assert_eq!(model.columns().last(), Some(&Column::Name));
        model.move_column(Column::Type, 0);
        model.move_column(Column::Type, 1);
        assert_eq!(model.columns()[0], Column::Type, "before its right neighbour it stays where it is");
    }
}
