"""Pages of the documentation, and the programs that make a site of them."""
