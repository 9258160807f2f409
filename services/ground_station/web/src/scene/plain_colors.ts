// SPDX-License-Identifier: Apache-2.0
// Colours are what the screen shows, not light to be added up: to convert each pixel from one to
// the other costs much where software draws. Imported before any colour is made.
import { ColorManagement } from "three";

ColorManagement.enabled = false;
