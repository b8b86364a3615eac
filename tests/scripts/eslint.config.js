// The rules for the scripts of all pages, in browsers without frameworks.
import js from "@eslint/js";
import globals from "globals";

const RULES = {
  ...js.configs.recommended.rules,
  complexity: ["error", 15],
  eqeqeq: "error",
  "no-var": "error",
  "prefer-const": ["error", { destructuring: "all" }],
  "no-shadow": "off",
  "no-unused-vars": ["error", { argsIgnorePattern: "^_", varsIgnorePattern: "^_" }],
  "no-implicit-globals": "error",
  "no-duplicate-imports": "error",
};

export default [
  { ignores: ["**/bundles/**", "**/node_modules/**", "**/*_actions.js"] },
  {
    files: ["graphkin/**/*.js"],
    languageOptions: {
      sourceType: "module",
      globals: { ...globals.browser, graphkinMotion: "readonly", SECTIONS: "readonly" },
    },
    rules: RULES,
  },
  {
    files: ["tests/scripts/**/*.js"],
    languageOptions: { sourceType: "module", globals: globals.node },
    rules: RULES,
  },
];
