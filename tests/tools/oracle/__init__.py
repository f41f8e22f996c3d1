"""What the program answers, as text that two trees can be compared by: numbers to the bit, words to the letter."""
