//! The 1971 paper, figure by figure.
