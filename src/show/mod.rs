//! What a run shows: the run log, progress on a terminal, summaries.
