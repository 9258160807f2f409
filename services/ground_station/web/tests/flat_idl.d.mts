export function flatIdl(type: string): string;
export const projectFolder: string;
