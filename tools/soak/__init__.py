"""The soak: minutes of faulty tensions, and books that have to balance."""
