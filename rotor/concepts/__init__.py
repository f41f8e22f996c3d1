"""Twist concepts: families of blades with a few named degrees of freedom (thesis chapter 4)."""

from rotor.concepts.catalogue import CONCEPTS as CONCEPTS
from rotor.concepts.catalogue import find_concept as find_concept
from rotor.concepts.concept import Concept as Concept
from rotor.concepts.concept import Handle as Handle
from rotor.concepts.concept import Parameter as Parameter
from rotor.concepts.concept import Values as Values
from rotor.concepts.concept import nearest as nearest
from rotor.concepts.variations import on_top as on_top
from rotor.concepts.variations import restrict as restrict
