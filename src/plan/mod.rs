//! The planner: statuses, their update after each measurement, the next best view.
