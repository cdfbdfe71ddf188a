function [ masks ] = element_masks( sol )
% ELEMENT_MASKS  Areas that get an outline: contact, slip, plasticity.

   masks = {sol.eldiv>0, sol.eldiv==2, sol.eldiv==3};

end % function element_masks
