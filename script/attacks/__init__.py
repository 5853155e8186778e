"""The cases of script/attack, one file for each class of input."""
