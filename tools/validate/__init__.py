"""The contact laws beside simulations that share no code with them; see docs/validation.md."""
