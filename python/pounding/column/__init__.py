"""Parts of run/column: level ground of layers that shear waves pass upwards, its moduli and damping as the strains leave them."""
