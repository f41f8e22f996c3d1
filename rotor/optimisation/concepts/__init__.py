"""Twist concepts: families of blades with a few named degrees of freedom (thesis chapter 4)."""

from rotor.optimisation.concepts.catalogue import CONCEPTS as CONCEPTS
from rotor.optimisation.concepts.catalogue import find_concept as find_concept
from rotor.optimisation.concepts.concept import Concept as Concept
from rotor.optimisation.concepts.concept import Handle as Handle
from rotor.optimisation.concepts.concept import Parameter as Parameter
from rotor.optimisation.concepts.concept import Values as Values
from rotor.optimisation.concepts.concept import nearest as nearest
from rotor.optimisation.concepts.concept import on_top as on_top
from rotor.optimisation.concepts.concept import restrict as restrict
