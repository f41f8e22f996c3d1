"""One lifting line for each blade and its wake: geometry by a closed form, influence matrix by Biot and Savart."""
