// The field's views of a material, in the order of their buttons.

import { view as albedo } from "./albedo.js";
import { view as image } from "./image.js";
import { view as lobe } from "./lobe.js";
import { view as polar } from "./polar.js";
import { view as slices } from "./slices.js";

export const VIEWS = [polar, lobe, slices, albedo, image];
