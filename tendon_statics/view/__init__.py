"""The live page in the browser: draws what the estimators of a rig say, and tells them nothing."""
