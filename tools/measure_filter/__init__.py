"""Measures `StickSlipFilter` on random sessions whose truth is known; see docs/filter.md."""
