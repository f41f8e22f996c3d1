"""Every command of the page, its key, and what the page must do for them."""
