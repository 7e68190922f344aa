"""Pages of the documentation, and the programs that build a site from them."""
