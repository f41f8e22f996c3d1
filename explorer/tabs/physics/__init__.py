"""The Physics tab: what each part of the physics costs."""
